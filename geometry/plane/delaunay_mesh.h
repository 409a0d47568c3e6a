#pragma once

#include <optional>

#include "geometry/plane/boundary_sampling.h"
#include "geometry/plane/region.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// How far a mesh is refined.
struct Refinement {
  int passes = 0;            ///< of Lloyd's relaxation
  int least_vertices = 0;    ///< the longest edges are halved until there are as many
  int most_vertices = 1000;  ///< no mesh where it would take more
};

/// Triangles of a region whose corners are `spacing` apart: its constrained Delaunay triangulation,
/// with vertices added until no edge is much longer than the spacing and no angle below 20.7°
/// (Ruppert, Shewchuk), but beside corners that are sharper; then relaxed, with vertices added
/// where an angle fell below again. Expects a checked region.
std::optional<Triangulation> delaunay_mesh(const Region& region, const Spacing& spacing,
                                           const Refinement& refinement);

}  // namespace deformlab
