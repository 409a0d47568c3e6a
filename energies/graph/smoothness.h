#pragma once

#include "energies/term.h"

namespace deformlab {

/// Neighbours are transformed alike: one column of R_j and R_k of an edge. Sumner et al. 2007
/// compare where the transformations take the nodes instead (Eq. 7), which sees nothing of a turn
/// about the edges themselves: a chain of nodes, such as a particle's path, can twist at no cost.
/// This can not.
template <int d = 3>
struct Smoothness {
  static constexpr std::string_view kName = "smoothness";
  static constexpr Structure kStructure = Structure::kKronecker;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;

  int column;

  template <class T>
  Vector<T, d> operator()(const Affine<T, d>& j, const Affine<T, d>& k) const {
    return j.R.col(column) - k.R.col(column);
  }

  /// All columns of every edge, each weighted by α_jk.
  static Terms<Smoothness> over(const DeformationGraph& graph) {
    Terms<Smoothness> sum{.arity = 2};
    for (const auto& [j, k, alpha] : graph.edges) {
      for (int c = 0; c < d; ++c) sum.add({c}, {j, k}, alpha);
    }
    return sum;
  }
};

}  // namespace deformlab
