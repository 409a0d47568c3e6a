#pragma once

#include "energies/graph/sums.h"

namespace deformlab {

/// Neighbouring nodes should rotate alike: the difference between R_j and R_k of an edge, in one
/// column. Sumner et al. 2007 compare the positions to which R_j and R_k take the nodes (Eq. 7).
/// These do not change with a rotation about the edges. Without this term, a chain of nodes, such
/// as the path of a particle, can therefore twist at no cost.
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
