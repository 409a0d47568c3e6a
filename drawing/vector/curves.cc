#include "drawing/vector/curves.h"

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

using Cubic = Eigen::Matrix<double, 2, 4>;

double length_of_control_polygon(const Cubic& c) {
  return (c.rightCols<3>() - c.leftCols<3>()).colwise().norm().sum();
}

/// The part of a cubic from parameter s to t. Blossoming gives its control points.
Cubic part(const Cubic& c, double s, double t) {
  const auto blossom = [&](double u, double v, double w) -> Eigen::Vector2d {
    const auto between = [](const auto& p, const auto& q, double x) -> Eigen::Vector2d {
      return (1 - x) * p + x * q;
    };
    const Eigen::Vector2d a = between(c.col(0), c.col(1), u), b = between(c.col(1), c.col(2), u),
                          d = between(c.col(2), c.col(3), u);
    return between(between(a, b, v), between(b, d, v), w);
  };
  Cubic result;
  result << blossom(s, s, s), blossom(s, s, t), blossom(s, t, t), blossom(t, t, t);
  return result;
}

}  // namespace

Curve polygon(const Eigen::Matrix2Xd& corners, bool closed) {
  const Eigen::Index n = corners.cols(), sides = closed ? n : n - 1;
  Curve curve{Eigen::Matrix2Xd(2, 3 * sides + 1), closed};
  for (Eigen::Index i = 0; i < sides; ++i) {
    const Eigen::Vector2d a = corners.col(i), b = corners.col((i + 1) % n);
    for (int k = 0; k < 4; ++k) curve.points.col(3 * i + k) = a + (b - a) * (k / 3.0);
    curve.points.col(3 * i + 3) = b;  // exactly where the next side begins
  }
  return curve;
}

Curve cut(const Curve& curve, double longest) {
  std::vector<Cubic> pieces;
  for (Eigen::Index i = 0; i + 3 < curve.points.cols(); i += 3) {
    const Cubic whole = curve.points.middleCols<4>(i);
    const double length = length_of_control_polygon(whole);
    const int count = std::max(1, static_cast<int>(std::ceil(length / longest)));
    for (int k = 0; k < count; ++k)
      pieces.push_back(count == 1 ? whole
                                  : part(whole, k / double(count), (k + 1) / double(count)));
  }
  Curve result{Eigen::Matrix2Xd(2, 3 * std::ssize(pieces) + 1), curve.closed};
  result.points.col(0) = curve.points.col(0);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    result.points.middleCols<3>(3 * static_cast<Eigen::Index>(k) + 1) = pieces[k].rightCols<3>();
  return result;
}

Paint one_color(const std::array<double, 4>& color) {
  Paint paint;
  paint.kind = Paint::Kind::kColor;
  paint.stops = {{0, color}};
  return paint;
}

}  // namespace deformlab
