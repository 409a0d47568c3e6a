#include "drawing/cut_sides.h"

#include <limits>

namespace deformlab {
namespace {

/// The way to a point from the nearest place on the lines.
Eigen::Vector2d way_from(const CutLines& lines, const Eigen::Vector2d& point) {
  Eigen::Vector2d nearest = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  for (const Eigen::Matrix2Xd& line : lines)
    for (Eigen::Index i = 0; i + 1 < line.cols(); ++i) {
      const Eigen::Vector2d way = way_from_segment(line.col(i), line.col(i + 1), point);
      if (way.squaredNorm() < nearest.squaredNorm()) nearest = way;
    }
  return nearest;
}

}  // namespace

Eigen::Matrix2Xd places_beside(const CutLines& cuts, const Eigen::Matrix2Xd& points,
                               const Triangulation& rest, const Locator& locator) {
  constexpr double kOnCut = 0.01;  // in mean edges
  Eigen::Matrix2Xd places = points;
  if (cuts.empty()) return places;
  const double edge = mean_edge_length(rest);
  for (auto place : places.colwise()) {
    const Eigen::Vector2d way = way_from(cuts, place);
    if (!(way.norm() < kOnCut * edge) || way.isZero(0)) continue;
    for (const double step : {0.125, 0.25, 0.5, 1.0, 2.0}) {
      const Eigen::Vector2d beside = place + step * edge * way.normalized();
      if (locator(beside).distance > 0) continue;
      place = beside;
      break;
    }
  }
  return places;
}

}  // namespace deformlab
