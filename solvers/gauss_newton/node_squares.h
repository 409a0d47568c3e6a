#pragma once

#include <vector>

#include "solvers/gauss_newton/linearization.h"

namespace deformlab {

/// What the terms that read one node each add to JᵀJ: a dense block a node, as Linearization has
/// it.
class NodeSquares {
 public:
  /// Finds the places of the nodes; called again where the ranks have changed.
  void compile(const Linearization& linearization);
  /// Hp += w JᵀJ p of all such terms where they were linearized last.
  void add_product(const Linearization& linearization, const ColumnBlock& p, ColumnBlock& Hp) const;

 private:
  std::vector<std::vector<int>> ranks_;  // of each part: of the columns that its elements read
};

}  // namespace deformlab
