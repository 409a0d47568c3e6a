#pragma once

#include <optional>
#include <string>

#include "geometry/graph/deformation_graph.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// Why a shape has no inside, as a clause for a message ("the shape has no faces"), or nothing if
/// its surface is closed: an even number of triangles meets at every edge. Vertices at one position
/// count as one.
std::optional<std::string> why_open(const Shape& shape);

/// Adds nodes inside a closed surface to a graph whose nodes are on it, and joins them. A hollow
/// shell loses its volume or unwinds where it is twisted by more than a half turn; with nodes
/// inside it resists. The new nodes follow those of the graph. They are on a body-centred cubic
/// grid, and are joined to all nodes within 1.7 spacings, except where the line between two nodes
/// would cross the surface. A node from which no edges lead to the surface is left out.
///   shape    closed (why_open)
///   spacing  the side of a cell of the grid, relative to the mean distance of a node of the graph
///            to its nearest neighbour. It becomes larger where there would be more than three
///            nodes inside for each node of the graph.
/// Edges of the new graph have weights by `alpha`. As no vertex follows nodes inside, there is no
/// overlap for them, and their edges then have the mean weight.
DeformationGraph with_interior(const Shape& shape, const DeformationGraph& graph, double spacing,
                               EdgeWeights alpha);

}  // namespace deformlab
