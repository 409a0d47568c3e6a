#include "drawing/cut_sides.h"

namespace deformlab {
namespace {

/// The direction away from all segments of the lines that are nearer to a point than `near`; zero
/// if none is. Where segments meet, it points into the middle of the corner.
Eigen::Vector2d way_from(const CutLines& lines, const Eigen::Vector2d& point, double near) {
  Eigen::Vector2d sum(0, 0);
  for (const Eigen::Matrix2Xd& line : lines)
    for (Eigen::Index i = 0; i + 1 < line.cols(); ++i) {
      const Eigen::Vector2d way = way_from_segment(line.col(i), line.col(i + 1), point);
      if (way.norm() < near) sum += way.normalized();
    }
  return sum.normalized();
}

}  // namespace

Eigen::Matrix2Xd places_beside(const CutLines& cuts, const Eigen::Matrix2Xd& points,
                               const Triangulation& rest, const Locator& locator) {
  constexpr double kOnCut = 0.01;  // in mean edges
  Eigen::Matrix2Xd places = points;
  if (cuts.empty()) return places;
  const double edge = mean_edge_length(rest);
  for (auto place : places.colwise()) {
    const Eigen::Vector2d way = way_from(cuts, place, kOnCut * edge);
    if (way.isZero(0)) continue;
    for (const double step : {0.125, 0.25, 0.5, 1.0, 2.0}) {
      const Eigen::Vector2d beside = place + step * edge * way;
      // What is nearer than half of the way to the cut lies on this side of it.
      if (locator(beside).distance > step * edge / 2) continue;
      place = beside;
      break;
    }
  }
  return places;
}

}  // namespace deformlab
