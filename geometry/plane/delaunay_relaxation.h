#pragma once

#include "geometry/plane/boundary_sampling.h"
#include "geometry/plane/delaunay.h"

namespace deformlab {

/// Relaxes a triangulation (Lloyd 1982). In each pass every inner vertex moves to a point beyond
/// the centroid of its Voronoi cell, whose density suits the spacing, and edges are flipped until
/// the triangulation is Delaunay again. Vertices on the boundary stay. Expects that faces know
/// whether they are inside.
void relax(Delaunay& delaunay, const Spacing& spacing, int passes);

}  // namespace deformlab
