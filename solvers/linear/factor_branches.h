#pragma once

#include <cstddef>
#include <vector>

namespace deformlab {

/// What of a triangular solve can be done side by side. Nodes of a forest stand for panels, in
/// postorder; a panel changes rows of its own and of its ancestors only.
struct FactorBranches {
  struct Range {
    int begin, end;  // nodes
  };
  /// Whole subtrees, about as much work in each branch; none where all is better done in turn.
  std::vector<std::vector<Range>> branches;
  std::vector<Range> top;  ///< the nodes above them, ascending
};

/// Depends on the forest alone, not on how many threads there are.
///   parent  of each node, a larger number, or −1 for a root
///   work    of each node
FactorBranches find_branches(const std::vector<int>& parent, const std::vector<std::size_t>& work);

}  // namespace deformlab
