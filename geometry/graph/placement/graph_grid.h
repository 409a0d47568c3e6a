#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Nodes on a regular grid over a flat shape (Sumner et al. 2007, Figure 5). The two longer sides
/// of the bounding box are cut into a·b = m equal cells, which are as square as that allows. The
/// node of a cell is the vertex that is nearest to its centre, seen along the shortest side of the
/// box. Returns m vertices, row by row. Throws OptionError ("nodes") for m out of range, where the
/// cells would be more than twice as long as wide (the message names better counts near m), and
/// where two cells have the same vertex.
std::vector<int> grid_nodes(const Shape& shape, int m);

}  // namespace deformlab
