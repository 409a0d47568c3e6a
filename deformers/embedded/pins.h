#pragma once

#include <string>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// A component of the graph whose moved vertices all lie in one place, with no node fixed.
struct PointPin {
  std::vector<int> nodes;
  std::vector<int> handles;  ///< columns of the handles' embedding
};

/// What hold_free_components found.
struct Pins {
  std::vector<PointPin> at_one_point;
  std::vector<std::string> notes;  ///< what a user should know, a sentence each
};

/// A component of the graph without a handle could float anywhere at no cost: its nodes are marked
/// in `fixed` (one entry a node), so that it stays where it is. One with too few handles may still
/// turn about them, which the solvers can take.
///   handles  the moved vertices; extent  the size of the shape, both [length].
Pins hold_free_components(const DeformationGraph& graph, const Embedding& handles, double extent,
                          std::vector<char>& fixed);

/// How many of the handles follow fixed nodes only, and so cannot move.
int count_immovable(const Embedding& handles, const std::vector<char>& fixed);

}  // namespace deformlab
