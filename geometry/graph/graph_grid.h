#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Nodes on a regular grid over a flat shape (Sumner et al. 2007, Figure 5): the two longer sides
/// of its bounding box are cut into equal cells, a·b = m of them and as square as that allows, and
/// the vertex nearest to the middle of each is taken, seen along the shortest side. Returns m
/// vertices, row by row. Throws InputError for m < 1, where the cells would be more than twice as
/// long as wide (and says which counts near m are better), or two cells have the same vertex.
std::vector<int> grid_nodes(const Shape& shape, int m);

}  // namespace deformlab
