#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// For every vertex of a shape, the sources that are nearest to it.
struct NearestSources {
  Eigen::MatrixXi sources;    ///< count×#V indices into the list of sources, the nearest first
  Eigen::MatrixXd distances;  ///< count×#V distances to these sources [length]
  Eigen::VectorXi found;      ///< #V, how many entries of each column are valid

  NearestSources(int count, Eigen::Index vertices);
  /// Enters a source if it is among the nearest. Of two sources that are equally far, the one that
  /// was entered first comes first.
  void insert(Eigen::Index vertex, int source, double distance);
};

/// The `count` sources (vertices) that are nearest to each vertex along the surface, by the heat
/// method (Crane, Weischedel and Wardetzky 2013). The method smooths distances and is inexact where
/// triangles are thin. Distances are therefore kept between that of the straight line and that of
/// the shortest path of nearest_along_edges; the mean error is then about 1.3 % within fifteen
/// edges. The time for a source is proportional to the size of its connected part of the surface: 5
/// ms for 10,000 vertices. Throws InputError where the faces do not form a manifold mesh, and where
/// a triangle has no area.
NearestSources nearest_along_surface(const Shape& shape, std::span<const int> sources, int count);

/// The same along the shortest paths over edges and straight across pairs of triangles. One search
/// of Dijkstra's from all sources at once stays local, so that its time does not grow with the
/// number of sources. Faces of any kind are allowed. The distances are too long, by 1.3 % in the
/// mean on scanned meshes. The error depends on the direction, most of all on regular meshes.
NearestSources nearest_along_edges(const Shape& shape, std::span<const int> sources, int count);

/// Calls visit(s, d) for each source s with the distances d of the heat method (#V) [length], which
/// are infinite for vertices on other parts of the surface. Throws as nearest_along_surface does.
void heat_distances(const Shape& shape, std::span<const int> sources,
                    const std::function<void(int s, const Eigen::VectorXd& d)>& visit);

/// The connected part of the surface to which each vertex belongs. Parts are numbered from 0 in the
/// order of their first vertices; a vertex without a face is a part of its own.
std::vector<int> connected_parts(const Shape& shape);

}  // namespace deformlab
