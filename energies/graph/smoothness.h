#pragma once

#include "energies/graph/sums.h"

namespace deformlab {

/// Neighbouring nodes are rotated alike: one column of R_j and R_k of an edge. Sumner et al. 2007
/// compare where the transformations take the nodes instead (Eq. 7). That does not see a rotation
/// about the edges themselves, so that a chain of nodes, such as the path of a particle, can twist
/// at no cost. With this term it cannot.
template <class Node = AffineNode<3>>
struct Smoothness {
  static constexpr std::string_view kName = "smoothness";
  static constexpr Structure kStructure =
      Node::kLinear ? Structure::kKronecker : Structure::kNonlinear;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;
  static constexpr int d = Node::kDimension;

  int column;

  template <class T>
  Vector<T, d> operator()(const State<Node, T>& j, const State<Node, T>& k) const {
    return j.axis(column) - k.axis(column);
  }

  /// All columns of every edge, each weighted by α_jk.
  static Terms<Smoothness> over(const GraphContext& context) {
    Terms<Smoothness> sum;
    for (const auto& [j, k, alpha] : context.graph.edges) {
      for (int c = 0; c < d; ++c) sum.add({c}, {j, k}, alpha);
    }
    return sum;
  }
};

}  // namespace deformlab
