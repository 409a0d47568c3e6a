#include "drawing/vector/curves.h"

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

double length_of_control_polygon(const Cubic& c) {
  return (c.rightCols<3>() - c.leftCols<3>()).colwise().norm().sum();
}

/// One cubic in place of all pieces from `begin` on, if these are parts of equal lengths in its
/// parameter.
Cubic united(const Eigen::Matrix2Xd& points, Eigen::Index begin, Eigen::Index count) {
  const Eigen::Index end = begin + 3 * count;
  Cubic whole;
  whole.col(0) = points.col(begin);
  whole.col(1) = points.col(begin) + double(count) * (points.col(begin + 1) - points.col(begin));
  whole.col(2) = points.col(end) + double(count) * (points.col(end - 1) - points.col(end));
  whole.col(3) = points.col(end);
  return whole;
}

/// Whether the pieces and the cubic that unites them have nearly the same control points.
bool agree(const Eigen::Matrix2Xd& points, Eigen::Index begin, Eigen::Index count,
           double tolerance) {
  const Cubic whole = united(points, begin, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Cubic piece = part(whole, double(k) / double(count), double(k + 1) / double(count));
    const Cubic own = points.middleCols<4>(begin + 3 * k);
    if ((piece - own).colwise().norm().maxCoeff() > tolerance) return false;
  }
  return true;
}

}  // namespace

// Blossoming gives the control points.
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

Curve closed(Curve curve) {
  const Eigen::Index end = curve.points.cols() - 1;
  if (curve.closed || end == 0) return curve;
  const Eigen::Vector2d a = curve.points.col(end), b = curve.points.col(0);
  curve.closed = true;
  if (a == b) return curve;
  curve.points.conservativeResize(2, end + 4);
  for (int k = 1; k < 3; ++k) curve.points.col(end + k) = a + (b - a) * (k / 3.0);
  curve.points.col(end + 3) = b;
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

Curve merged(const Curve& curve, double tolerance) {
  const Eigen::Matrix2Xd& points = curve.points;
  const Eigen::Index pieces = (points.cols() - 1) / 3;
  Curve result{points, curve.closed};
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < pieces;) {
    Eigen::Index count = 1;
    while (i + count < pieces && agree(points, 3 * i, count + 1, tolerance)) ++count;
    result.points.middleCols<3>(3 * kept + 1) = united(points, 3 * i, count).rightCols<3>();
    i += count;
    ++kept;
  }
  result.points.conservativeResize(2, 3 * kept + 1);
  return result;
}

Paint one_color(const std::array<double, 4>& color) {
  Paint paint;
  paint.kind = Paint::Kind::kColor;
  paint.stops = {{0, color}};
  return paint;
}

}  // namespace deformlab
