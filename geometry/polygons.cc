#include "geometry/polygons.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace deformlab {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Segment = Kernel::Segment_2;
using Eigen::Index;

Point at(const Eigen::Matrix2Xd& polygon, Index i) {
  i %= polygon.cols();
  return {polygon(0, i), polygon(1, i)};
}

Segment segment(const Polygons& polygons, const PolygonEdge& edge) {
  const Eigen::Matrix2Xd& polygon = polygons[edge.polygon];
  return {at(polygon, edge.corner), at(polygon, edge.corner + 1)};
}

// Does the second edge, which begins where the first ends, run back along it?
bool fold_back(const Segment& e, const Segment& next) {
  const Point a = e.source(), b = e.target(), c = next.target();
  return CGAL::collinear(a, b, c) && !CGAL::collinear_are_ordered_along_line(a, b, c);
}

bool edges_meet(const Polygons& polygons, const PolygonEdge& e, const PolygonEdge& f) {
  const Segment one = segment(polygons, e), other = segment(polygons, f);
  if (e.polygon == f.polygon) {
    const Index n = polygons[e.polygon].cols();
    if ((e.corner + 1) % n == f.corner) return fold_back(one, other);
    if ((f.corner + 1) % n == e.corner) return fold_back(other, one);
  }
  return CGAL::do_intersect(one, other);
}

}  // namespace

void for_edges_that_meet(const Polygons& polygons,
                         const std::function<void(const PolygonEdge&, const PolygonEdge&)>& meet) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, PolygonEdge>;
  std::vector<Box> boxes;
  for (int p = 0; p < static_cast<int>(polygons.size()); ++p) {
    for (Index i = 0; i < polygons[p].cols(); ++i) {
      boxes.emplace_back(segment(polygons, {p, i}).bbox(), PolygonEdge{p, i});
    }
  }
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const auto [e, f] = std::minmax({a.info(), b.info()});
    if (edges_meet(polygons, e, f)) meet(e, f);
  });
}

std::vector<std::vector<int>> nesting(const Polygons& polygons) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;
  std::vector<std::vector<Point>> corners(polygons.size());
  std::vector<Box> firsts, extents;  // as no edges meet, a polygon is where one of its corners is
  for (int p = 0; p < static_cast<int>(polygons.size()); ++p) {
    for (Index i = 0; i < polygons[p].cols(); ++i) corners[p].push_back(at(polygons[p], i));
    extents.emplace_back(CGAL::bbox_2(corners[p].begin(), corners[p].end()), p);
    firsts.emplace_back(corners[p][0].bbox(), p);
  }
  std::vector<std::vector<int>> around(polygons.size());
  const auto test = [&](const Box& first, const Box& extent) {
    const int inner = first.info(), outer = extent.info();
    if (inner == outer) return;
    const auto side = CGAL::bounded_side_2(corners[outer].begin(), corners[outer].end(),
                                           corners[inner][0], Kernel());
    if (side == CGAL::ON_BOUNDED_SIDE) around[inner].push_back(outer);
  };
  CGAL::box_intersection_d(firsts.begin(), firsts.end(), extents.begin(), extents.end(), test);
  for (auto& outer : around) std::ranges::sort(outer);
  return around;
}

}  // namespace deformlab
