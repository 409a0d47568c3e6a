#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace deformlab {

/// From one corner of one of several closed polygons to the next; or that corner itself.
struct PolygonEdge {
  int polygon;
  Eigen::Index corner;
  friend auto operator<=>(const PolygonEdge&, const PolygonEdge&) = default;
};

using Polygons = std::vector<Eigen::Matrix2Xd>;

/// Calls `meet(e, f)`, e < f, for all edges that share more than the corner at which one follows
/// the other, in no order that means anything. Exact.
void for_edges_that_meet(const Polygons& polygons,
                         const std::function<void(const PolygonEdge&, const PolygonEdge&)>& meet);

/// The first corner that is nearer than that to an edge that neither begins nor ends there.
std::optional<PolygonEdge> corner_near_edge(const Polygons& polygons, double distance);

/// For each polygon the others that it lies in, sorted; provided that no edges meet. Exact.
std::vector<std::vector<int>> nesting(const Polygons& polygons);

}  // namespace deformlab
