#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <optional>

#include "geometry/plane/polygons.h"
#include "geometry/plane/region.h"
#include "geometry/shape/usable.h"

namespace deformlab {
namespace {

using Eigen::Index;

// Polygon 0 is the outline. The holes follow.
std::string called(int polygon) {
  return polygon == 0 ? "the outline" : fmt::format("hole {}", polygon - 1);
}

std::string written(const Eigen::Vector2d& p) { return fmt::format("({:g}, {:g})", p[0], p[1]); }

Eigen::Matrix2Xd without_repeated(const Eigen::Matrix2Xd& polygon, int number,
                                  const std::string& name) {
  std::vector<Index> kept;
  for (Index i = 0; i < polygon.cols(); ++i) {
    if (!polygon.col(i).allFinite()) {
      cannot_use(name,
                 fmt::format("corner {} of {} (counted from 0) is at {}; every number must be "
                             "finite",
                             i, called(number), written(polygon.col(i))));
    }
    if (kept.empty() || polygon.col(i) != polygon.col(kept.back())) kept.push_back(i);
  }
  while (kept.size() > 1 && polygon.col(kept.back()) == polygon.col(kept[0])) kept.pop_back();
  if (kept.size() < 3) {
    cannot_use(name, fmt::format("{} has {} different corners; at least 3 are needed",
                                 called(number), kept.size()));
  }
  return polygon(Eigen::all, kept);
}

std::array<Eigen::Vector2d, 2> ends(const Polygons& polygons, const PolygonEdge& edge) {
  const auto& polygon = polygons[edge.polygon];
  return {polygon.col(edge.corner), polygon.col((edge.corner + 1) % polygon.cols())};
}

std::string described(const Polygons& polygons, const PolygonEdge& edge) {
  const auto [from, to] = ends(polygons, edge);
  return fmt::format("edge {} of {}, {} to {},", edge.corner, called(edge.polygon), written(from),
                     written(to));
}

std::string meeting_place(const Polygons& polygons, const PolygonEdge& e, const PolygonEdge& f) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto segment = [&](const PolygonEdge& edge) {
    const auto [a, b] = ends(polygons, edge);
    return Kernel::Segment_2({a[0], a[1]}, {b[0], b[1]});
  };
  const auto where = CGAL::intersection(segment(e), segment(f));
  if (!where) return "";  // the point exists, but rounding may lose it
  const auto* point = boost::get<Kernel::Point_2>(&*where);
  const auto place = point ? *point : boost::get<Kernel::Segment_2>(*where).source();
  return " at " + written({place.x(), place.y()});
}

void check_crossings(const Polygons& polygons, const std::string& name) {
  std::optional<std::pair<PolygonEdge, PolygonEdge>> first;
  for_edges_that_meet(polygons, [&](const PolygonEdge& e, const PolygonEdge& f) {
    if (!first || std::pair(e, f) < *first) first = {e, f};
  });
  if (!first) return;
  const auto& [e, f] = *first;
  cannot_use(name, fmt::format("{} meets {}{}; polygons may neither cross nor touch themselves or "
                               "each other",
                               described(polygons, e), described(polygons, f),
                               meeting_place(polygons, e, f)));
}

void check_nesting(const Polygons& polygons, const std::string& name) {
  const std::vector<std::vector<int>> around = nesting(polygons);
  for (int h = 1; h < static_cast<int>(polygons.size()); ++h) {
    if (around[h].empty() || around[h][0] != 0)
      cannot_use(name, fmt::format("{} is not inside the outline", called(h)));
    if (around[h].size() == 1) continue;
    cannot_use(name, fmt::format("{} is inside {}; holes must be apart: leave it out, or make it a "
                                 "shape of its own",
                                 called(h), called(around[h].back())));
  }
}

void turn(Eigen::Matrix2Xd& polygon, bool positive) {
  if ((signed_area(polygon) > 0) != positive) polygon.rowwise().reverseInPlace();
}

}  // namespace

Region checked(const Region& region, const std::string& name) {
  Polygons polygons{without_repeated(region.outline, 0, name)};
  for (const auto& hole : region.holes) {
    polygons.push_back(without_repeated(hole, static_cast<int>(polygons.size()), name));
  }
  check_extent(polygons[0], name);
  check_crossings(polygons, name);
  check_nesting(polygons, name);
  Region result{polygons[0], {polygons.begin() + 1, polygons.end()}};
  turn(result.outline, true);
  for (auto& hole : result.holes) turn(hole, false);
  return result;
}

}  // namespace deformlab
