#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace deformlab {

/// Two parts of a shape that must not pull at each other though they are close, such as a hand and
/// the leg beside it: the stroke between them of Sumner et al. 2007, section 6.
struct Cut {
  std::vector<int> a, b;     ///< vertices, in any order; the rest of the shape is on neither side
  std::string name = "cut";  ///< what messages call it: "cut 2 (line 7 of edit.yaml)"
};

/// A shape's vertices in groups that may follow the same nodes.
struct CutGroups {
  std::vector<int> of_vertex;            ///< group of each vertex
  std::vector<int> of_node;              ///< of each node: that of the vertex nearest to it
  std::vector<std::vector<char>> apart;  ///< whether two groups are on different sides of a cut
  /// The nodes that vertices of a group may follow, ascending.
  std::vector<std::vector<int>> nodes;
};

/// Groups the vertices by the sides of all cuts that they are on; without cuts all are one group.
///   node_vertices  the vertex nearest to each node; without cuts there need be none
/// Throws InputError where a side has no vertex or one that does not exist, a vertex is on both
/// sides, or vertices would be left without any node to follow.
CutGroups group(Eigen::Index vertices, std::span<const int> node_vertices,
                std::span<const Cut> cuts);

}  // namespace deformlab
