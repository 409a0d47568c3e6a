#include "drawing/bitmap/cut_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace deformlab {
namespace {

constexpr double kHalf = 0.75;  // width of a cut; with less, pixels stay connected across a corner

/// The indices of the pixels that lie between two coordinates or beside them.
std::pair<Eigen::Index, Eigen::Index> range(double a, double b, Eigen::Index size) {
  const auto last = static_cast<double>(size - 1);
  const auto index = [&](double at) {
    return static_cast<Eigen::Index>(std::clamp(std::floor(at), 0.0, last));
  };
  return {index(std::min(a, b) - 1), index(std::max(a, b) + 1)};
}

}  // namespace

Eigen::Vector2d way_from_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                 const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = to - from;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0;
  return point - from - t * along;
}

std::vector<std::string> cut_along(const CutLines& lines, double resolution,
                                   Eigen::ArrayXXf& alpha) {
  std::vector<std::string> notes;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const Eigen::Matrix2Xd& line = lines[l];
    bool meets = false;
    for (Eigen::Index i = 0; i + 1 < line.cols(); ++i) {
      const Eigen::Vector2d from = resolution * line.col(i), to = resolution * line.col(i + 1);
      const auto [left, right] = range(from.x(), to.x(), alpha.cols());
      const auto [top, bottom] = range(from.y(), to.y(), alpha.rows());
      for (Eigen::Index y = top; y <= bottom; ++y)
        for (Eigen::Index x = left; x <= right; ++x)
          if (alpha(y, x) > 0 && way_from_segment(from, to, {x + 0.5, y + 0.5}).norm() < kHalf) {
            alpha(y, x) = 0;
            meets = true;
          }
    }
    if (!meets) {
      notes.push_back(fmt::format(
          "cut[{}], from ({:g}, {:g}) to ({:g}, {:g}), cuts nothing: it meets no part of the "
          "drawing",
          l, line(0, 0), line(1, 0), line(0, line.cols() - 1), line(1, line.cols() - 1)));
    }
  }
  return notes;
}

}  // namespace deformlab
