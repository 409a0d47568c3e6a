#pragma once

#include <span>
#include <vector>

#include "geometry/shape/weld.h"
#include "geometry/transfer/surface_roads.h"

namespace deformlab {

/// The vertices between which paths over a surface are measured, and the roads between them.
struct PathStops {
  std::vector<int> vertices;
  std::vector<int> of_vertex;  ///< the stop that is nearest to each vertex along edges
  Roads roads;                 ///< between stops
};

/// Chooses the stops for paths from some sources (vertices). On a small mesh every vertex is a
/// stop. On a large one they are the sources, and one vertex of each part of the surface in each
/// cell of a grid, ten for each source. Only the first vertex of a place is a stop.
///   T     the welded triangles of the surface
///   part  their connected parts
PathStops choose_path_stops(const WeldedSurface& surface, const Eigen::Matrix3Xi& T,
                            std::span<const int> part, std::span<const int> sources);

}  // namespace deformlab
