#pragma once

#include "geometry/boundary_sampling.h"
#include "geometry/region.h"
#include "geometry/triangulation.h"

namespace deformlab {

/// Triangles of a region whose corners are `spacing` apart: its constrained Delaunay triangulation,
/// with vertices added until no edge is much longer than the spacing and no angle below 20.7°
/// (Ruppert, Shewchuk), but beside corners that are sharper; then so many passes of Lloyd's
/// relaxation, and vertices where an angle fell below again. Expects a checked region.
Triangulation delaunay_mesh(const Region& region, const Spacing& spacing, int passes);

}  // namespace deformlab
