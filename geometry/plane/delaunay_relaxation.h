#pragma once

#include "geometry/plane/boundary_sampling.h"
#include "geometry/plane/delaunay.h"

namespace deformlab {

/// So many passes of Lloyd's relaxation (1982): each vertex off the boundary moves beyond the
/// centre of its Voronoi cell, of a density that suits the spacing, and edges are flipped until the
/// triangulation is Delaunay again. Vertices on the boundary stay. Expects that faces know whether
/// they are inside.
void relax(Delaunay& delaunay, const Spacing& spacing, int passes);

}  // namespace deformlab
