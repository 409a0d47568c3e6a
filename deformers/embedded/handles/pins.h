#pragma once

#include <string>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/transfer/embedding.h"

namespace deformlab {

/// A component of the graph whose handles all lie at one point and that has no fixed node.
struct PointPin {
  std::vector<int> nodes;
  std::vector<int> handles;  ///< columns of the handles' embedding
};

/// The result of pin_free_components.
struct Pins {
  std::vector<PointPin> at_one_point;
  /// The handles of each component whose handles lie nearly on a line (kNearLine) and that has no
  /// fixed node.
  std::vector<std::vector<int>> on_one_line;
  std::vector<std::string> notes;  ///< what a user should know, one sentence each
};

/// A component of the graph without a handle could move anywhere at no cost. Its nodes are marked
/// in `fixed` (one entry per node), so that it stays where it is. A component with too few handles
/// may still rotate about them, which the solvers allow.
///   handles    the handles that move [length]
///   extent     the size of the shape [length]
///   dimension  2 in the plane, where handles on a line hold a rotation, or 3
Pins pin_free_components(const DeformationGraph& graph, const Embedding& handles, double extent,
                         int dimension, std::vector<char>& fixed);

/// The weights with which a column of an embedding follows nodes that are not fixed, in sum.
double influence_of_free(const Embedding& embedding, Eigen::Index column,
                         const std::vector<char>& fixed);

/// How many of the first `count` handles follow fixed nodes only and so cannot move.
int count_immovable(const Embedding& handles, Eigen::Index count, const std::vector<char>& fixed);

}  // namespace deformlab
