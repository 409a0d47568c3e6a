#pragma once

#include <optional>

#include "geometry/plane/boundary_sampling.h"
#include "geometry/plane/region.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

struct Refinement {
  int passes = 0;            ///< number of passes of Lloyd's relaxation
  int least_vertices = 0;    ///< vertices are added at the longest edges until there are as many
  int most_vertices = 1000;  ///< there is no result where more are needed
};

/// Cuts a region whose corners are `spacing` apart into triangles. Its constrained Delaunay
/// triangulation gets more vertices until no edge is much longer than the spacing and no angle is
/// below 20.7° (Ruppert, Shewchuk), except beside sharper corners of the region. Then it is
/// relaxed, and gets more vertices where an angle has become too small. Expects a checked region.
std::optional<Triangulation> delaunay_mesh(const Region& region, const Spacing& spacing,
                                           const Refinement& refinement);

}  // namespace deformlab
