#include "geometry/plane/region.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Polyline_simplification_2/simplify.h>

#include <Eigen/Geometry>

#include "geometry/plane/cross.h"

namespace deformlab {
namespace {

namespace simplification = CGAL::Polyline_simplification_2;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;

double length(const Eigen::Matrix2Xd& polygon) {
  const Eigen::Index n = polygon.cols();
  if (n == 0) return 0;
  return (polygon.rightCols(n - 1) - polygon.leftCols(n - 1)).colwise().norm().sum() +
         (polygon.col(0) - polygon.col(n - 1)).norm();
}

Polygon to_cgal(const Eigen::Matrix2Xd& corners) {
  Polygon result;
  for (const auto& corner : corners.colwise()) result.push_back({corner[0], corner[1]});
  return result;
}

Eigen::Matrix2Xd from_cgal(const Polygon& polygon) {
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(polygon.size()));
  for (Eigen::Index i = 0; i < result.cols(); ++i) {
    const auto& corner = polygon[static_cast<std::size_t>(i)];
    result.col(i) << corner.x(), corner.y();
  }
  return result;
}

// Whether a ray from the point along x crosses the polygon an odd number of times.
bool crossed_an_odd_number_of_times(const Eigen::Matrix2Xd& polygon, const Eigen::Vector2d& point) {
  bool odd = false;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    odd = odd != (x > point.x());
  }
  return odd;
}

}  // namespace

double signed_area(const Eigen::Matrix2Xd& polygon) {
  double twice = 0;  // measured from a corner, so that a region far from the origin loses no digits
  for (Eigen::Index i = 2; i < polygon.cols(); ++i) {
    twice += cross(polygon.col(i - 1) - polygon.col(0), polygon.col(i) - polygon.col(0));
  }
  return twice / 2;
}

double area(const Region& region) {
  double result = std::abs(signed_area(region.outline));
  for (const auto& hole : region.holes) result -= std::abs(signed_area(hole));
  return result;
}

double perimeter(const Region& region) {
  double result = length(region.outline);
  for (const auto& hole : region.holes) result += length(hole);
  return result;
}

bool contains(const Region& region, const Eigen::Vector2d& point) {
  bool inside = crossed_an_odd_number_of_times(region.outline, point);
  for (const auto& hole : region.holes) {
    inside = inside != crossed_an_odd_number_of_times(hole, point);
  }
  return inside;
}

Region simplified(const Region& region, double tolerance) {
  CGAL::Polygon_with_holes_2<Kernel> polygons(to_cgal(region.outline));
  for (const auto& hole : region.holes) polygons.add_hole(to_cgal(hole));
  polygons =
      simplification::simplify(polygons, simplification::Squared_distance_cost(),
                               simplification::Stop_above_cost_threshold(tolerance * tolerance));
  Region result{from_cgal(polygons.outer_boundary()), {}};
  for (const auto& hole : polygons.holes()) result.holes.push_back(from_cgal(hole));
  return result;
}

}  // namespace deformlab
