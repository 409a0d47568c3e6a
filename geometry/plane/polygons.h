#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace deformlab {

/// The edge of a closed polygon from a corner to the next one, or that corner itself.
struct PolygonEdge {
  int polygon;
  Eigen::Index corner;
  friend auto operator<=>(const PolygonEdge&, const PolygonEdge&) = default;
};

using Polygons = std::vector<Eigen::Matrix2Xd>;

/// Calls `meet(e, f)`, e < f, for all edges that share more than the corner at which one follows
/// the other, in no particular order. The test is exact.
void for_edges_that_meet(const Polygons& polygons,
                         const std::function<void(const PolygonEdge&, const PolygonEdge&)>& meet);

/// The first corner that is nearer than `distance` [length] to an edge that does not end there.
std::optional<PolygonEdge> corner_near_edge(const Polygons& polygons, double distance);

/// For each polygon the sorted numbers of the polygons that contain it. Expects that no edges meet.
/// The test is exact.
std::vector<std::vector<int>> nesting(const Polygons& polygons);

}  // namespace deformlab
