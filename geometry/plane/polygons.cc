#include "geometry/plane/polygons.h"

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

// Whether the second edge, which begins where the first ends, runs back along it.
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

double squared_distance(const Polygons& polygons, const PolygonEdge& corner,
                        const PolygonEdge& edge) {
  return CGAL::squared_distance(at(polygons[corner.polygon], corner.corner),
                                segment(polygons, edge));
}

bool is_end(const Polygons& polygons, const PolygonEdge& corner, const PolygonEdge& edge) {
  if (corner.polygon != edge.polygon) return false;
  return corner.corner == edge.corner ||
         corner.corner == (edge.corner + 1) % polygons[edge.polygon].cols();
}

using EdgeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, PolygonEdge>;

std::vector<EdgeBox> edge_boxes(const Polygons& polygons) {
  std::vector<EdgeBox> boxes;
  for (int p = 0; p < static_cast<int>(polygons.size()); ++p) {
    for (Index i = 0; i < polygons[p].cols(); ++i) {
      boxes.emplace_back(segment(polygons, {p, i}).bbox(), PolygonEdge{p, i});
    }
  }
  return boxes;
}

}  // namespace

void for_edges_that_meet(const Polygons& polygons,
                         const std::function<void(const PolygonEdge&, const PolygonEdge&)>& meet) {
  std::vector<EdgeBox> boxes = edge_boxes(polygons);
  const auto test = [&](const EdgeBox& a, const EdgeBox& b) {
    const auto [e, f] = std::minmax({a.info(), b.info()});
    if (edges_meet(polygons, e, f)) meet(e, f);
  };
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), test);
}

std::optional<PolygonEdge> corner_near_edge(const Polygons& polygons, double distance) {
  std::vector<EdgeBox> edges = edge_boxes(polygons), corners;
  for (const EdgeBox& edge : edges) {
    const Point corner = at(polygons[edge.info().polygon], edge.info().corner);
    const CGAL::Bbox_2 around(corner.x() - distance, corner.y() - distance, corner.x() + distance,
                              corner.y() + distance);
    corners.emplace_back(around, edge.info());
  }
  std::optional<PolygonEdge> first;
  const auto test = [&](const EdgeBox& a, const EdgeBox& b) {
    const PolygonEdge corner = a.info(), edge = b.info();
    if ((first && *first <= corner) || is_end(polygons, corner, edge)) return;
    if (squared_distance(polygons, corner, edge) < distance * distance) first = corner;
  };
  CGAL::box_intersection_d(corners.begin(), corners.end(), edges.begin(), edges.end(), test);
  return first;
}

std::vector<std::vector<int>> nesting(const Polygons& polygons) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;
  std::vector<std::vector<Point>> corners(polygons.size());
  std::vector<Box> firsts, extents;  // no edges meet, so that the first corner tells for all
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
