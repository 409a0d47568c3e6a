#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace deformlab {

/// Two parts of a shape that must not influence each other although they are close, such as a hand
/// and the leg beside it. Sumner et al. 2007, section 6, draw a stroke between them.
struct Cut {
  std::vector<int> a, b;     ///< vertices, in any order; the rest of the shape is on neither side
  std::string name = "cut";  ///< its name in messages, such as "cut 2 (line 7 of edit.yaml)"
};

/// A shape's vertices in groups that may follow the same nodes.
struct CutGroups {
  std::vector<int> of_vertex;            ///< the group of each vertex
  std::vector<int> of_node;              ///< the group of the vertex that is nearest to each node
  std::vector<std::vector<char>> apart;  ///< whether two groups are on different sides of a cut
  /// The nodes that the vertices of each group may follow, in ascending order.
  std::vector<std::vector<int>> nodes;
};

/// Groups the vertices by the sides of the cuts that they are on. Without cuts there is one group.
///   node_vertices  the vertex nearest to each node; may be empty without cuts
/// Throws InputError where a side has no vertex or a vertex that does not exist, where a vertex is
/// on both sides, and where vertices would have no node to follow.
CutGroups group(Eigen::Index vertices, std::span<const int> node_vertices,
                std::span<const Cut> cuts);

}  // namespace deformlab
