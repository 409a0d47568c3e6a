#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

#include "geometry/error.h"
#include "geometry/region.h"
#include "geometry/shape.h"

namespace deformlab {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Index = Eigen::Index;

[[noreturn]] void reject(const std::string& name, const std::string& what) {
  throw InputError("cannot use '" + name + "': " + what);
}

Point at(const Eigen::Matrix2Xd& polygon, Index i) {
  i %= polygon.cols();
  return {polygon(0, i), polygon(1, i)};
}

std::string written(const Point& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ")";
  return text.str();
}

// The outline and the holes, numbered in a row; 0 is the outline.
class Polygons {
 public:
  Polygons(const Region& region, std::string name) : name_(std::move(name)) {
    polygons_.push_back(cleaned(region.outline, 0));
    for (const auto& hole : region.holes) {
      polygons_.push_back(cleaned(hole, static_cast<int>(polygons_.size())));
    }
  }
  void check_extent() const;
  void check_crossings() const;
  void check_nesting() const;
  Region region() const;

 private:
  // From corner `corner` of a polygon to the next.
  struct Edge {
    int polygon;
    Index corner;
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };
  using PolygonBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const Edge*>;

  static std::string called(int polygon) {
    return polygon == 0 ? "the outline" : "hole " + std::to_string(polygon - 1);
  }
  Eigen::Matrix2Xd cleaned(const Eigen::Matrix2Xd& polygon, int number) const;
  Kernel::Segment_2 segment(const Edge& edge) const {
    return {at(polygons_[edge.polygon], edge.corner), at(polygons_[edge.polygon], edge.corner + 1)};
  }
  std::vector<Edge> edges() const;
  std::vector<Box> boxes(const std::vector<Edge>& edges) const;
  bool meet(const Edge& e, const Edge& f) const;
  bool fold_back(const Edge& e, const Edge& next) const;
  std::string described(const Edge& edge) const;

  std::string name_;
  std::vector<Eigen::Matrix2Xd> polygons_;
};

Eigen::Matrix2Xd Polygons::cleaned(const Eigen::Matrix2Xd& polygon, int number) const {
  std::vector<Index> kept;
  for (Index i = 0; i < polygon.cols(); ++i) {
    if (!polygon.col(i).allFinite()) {
      reject(name_, "corner " + std::to_string(i) + " of " + called(number) +
                        " (counted from 0) is at " + written(at(polygon, i)) +
                        "; every number must be finite");
    }
    if (kept.empty() || polygon.col(i) != polygon.col(kept.back())) kept.push_back(i);
  }
  while (kept.size() > 1 && polygon.col(kept.back()) == polygon.col(kept[0])) kept.pop_back();
  if (kept.size() < 3) {
    reject(name_, called(number) + " has " + std::to_string(kept.size()) +
                      " different corners; at least 3 are needed");
  }
  return polygon(Eigen::all, kept);
}

// Areas and energies hold the fourth power of a length: it must not leave the range of a double.
void Polygons::check_extent() const {
  const auto& outline = polygons_[0];
  const double across = (outline.rowwise().maxCoeff() - outline.rowwise().minCoeff()).stableNorm();
  const double farthest = outline.cwiseAbs().maxCoeff();
  if (across >= kLeastLength && across <= kMostLength && farthest <= kMostLength) return;
  std::ostringstream what;
  what << "it is " << across << " across and reaches " << farthest
       << " from the origin; allowed are " << kLeastLength << " to " << kMostLength << ": scale it";
  reject(name_, what.str());
}

std::vector<Polygons::Edge> Polygons::edges() const {
  std::vector<Edge> result;
  for (int p = 0; p < static_cast<int>(polygons_.size()); ++p) {
    for (Index i = 0; i < polygons_[p].cols(); ++i) result.push_back({p, i});
  }
  return result;
}

std::vector<Polygons::Box> Polygons::boxes(const std::vector<Edge>& edges) const {
  std::vector<Box> result;
  result.reserve(edges.size());
  for (const Edge& edge : edges) result.emplace_back(segment(edge).bbox(), &edge);
  return result;
}

// Do the edges share more than the corner at which one follows the other?
bool Polygons::meet(const Edge& e, const Edge& f) const {
  if (e.polygon == f.polygon) {
    const Index n = polygons_[e.polygon].cols();
    if ((e.corner + 1) % n == f.corner) return fold_back(e, f);
    if ((f.corner + 1) % n == e.corner) return fold_back(f, e);
  }
  return CGAL::do_intersect(segment(e), segment(f));
}

bool Polygons::fold_back(const Edge& e, const Edge& next) const {
  const Point a = segment(e).source(), b = segment(e).target(), c = segment(next).target();
  return CGAL::collinear(a, b, c) && !CGAL::collinear_are_ordered_along_line(a, b, c);
}

std::string Polygons::described(const Edge& edge) const {
  return "edge " + std::to_string(edge.corner) + " of " + called(edge.polygon) + ", " +
         written(segment(edge).source()) + " to " + written(segment(edge).target()) + ",";
}

void Polygons::check_crossings() const {
  const std::vector<Edge> all = edges();
  std::vector<Box> boxed = boxes(all);
  std::optional<std::pair<Edge, Edge>> first;  // so that the message does not depend on the search
  CGAL::box_self_intersection_d(boxed.begin(), boxed.end(), [&](const Box& one, const Box& other) {
    const auto [e, f] = std::minmax(*one.handle(), *other.handle());
    if (meet(e, f) && (!first || std::pair(e, f) < *first)) first = {e, f};
  });
  if (!first) return;
  const auto& [e, f] = *first;
  std::string what = described(e) + " meets " + described(f);
  if (const auto where = CGAL::intersection(segment(e), segment(f))) {
    const Point* place = boost::get<Point>(&*where);
    what += " at " + written(place ? *place : boost::get<Kernel::Segment_2>(*where).source());
  }
  reject(name_, what + "; polygons may neither cross nor touch themselves or each other");
}

// As no edges meet, a hole is where one of its corners is.
void Polygons::check_nesting() const {
  std::vector<std::vector<Point>> corners(polygons_.size());
  std::vector<PolygonBox> first_corners, extents;
  for (int p = 0; p < static_cast<int>(polygons_.size()); ++p) {
    for (Index i = 0; i < polygons_[p].cols(); ++i) corners[p].push_back(at(polygons_[p], i));
    extents.emplace_back(CGAL::bbox_2(corners[p].begin(), corners[p].end()), p);
    if (p > 0) first_corners.emplace_back(corners[p][0].bbox(), p);
  }
  std::vector<std::set<int>> around(polygons_.size());
  const auto test = [&](const PolygonBox& corner, const PolygonBox& extent) {
    const int hole = corner.info(), other = extent.info();
    const auto& polygon = corners[other];
    if (hole == other || CGAL::bounded_side_2(polygon.begin(), polygon.end(), corners[hole][0],
                                              Kernel()) != CGAL::ON_BOUNDED_SIDE)
      return;
    around[hole].insert(other);
  };
  CGAL::box_intersection_d(first_corners.begin(), first_corners.end(), extents.begin(),
                           extents.end(), test);
  for (int h = 1; h < static_cast<int>(polygons_.size()); ++h) {
    if (!around[h].contains(0)) reject(name_, called(h) + " is not inside the outline");
    if (around[h].size() == 1) continue;
    reject(name_, called(h) + " is inside " + called(*around[h].rbegin()) +
                      "; holes must be apart: leave it out, or make it a shape of its own");
  }
}

Region Polygons::region() const {
  Region result;
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    const bool turned = (signed_area(polygons_[p]) > 0) != (p == 0);
    Eigen::Matrix2Xd polygon = polygons_[p];
    if (turned) polygon.rowwise().reverseInPlace();
    p == 0 ? result.outline = polygon : result.holes.emplace_back(polygon);
  }
  return result;
}

}  // namespace

Region checked(const Region& region, const std::string& name) {
  const Polygons polygons(region, name);
  polygons.check_extent();
  polygons.check_crossings();
  polygons.check_nesting();
  return polygons.region();
}

}  // namespace deformlab
