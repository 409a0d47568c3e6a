#pragma once

#include <vector>

#include "solvers/linearization.h"

namespace deformlab {

/// What the terms that read one node each add to JᵀJ: one dense block a node, summed over the
/// terms, so that a product with it costs the same however many there are.
class NodeSquares {
 public:
  /// Finds the nodes and their places; called again where the ranks have changed.
  void compile(const Stage& stage, const Linearization& linearization);
  /// Sums the blocks where the stage was linearized last.
  void sum(const Linearization& linearization);
  /// Hp += blocks · p.
  void add_product(const Columns4& p, Columns4& Hp) const;

 private:
  int dimension_ = 0, width_ = 0;  // columns of a block
  std::vector<int> rank_;          // of each block's columns
  // Of each block and entry (column q, coordinate i) of what it is multiplied with, width_ times
  // four numbers: what that adds to its columns.
  std::vector<double> values_;
  std::vector<int> block_of_;  // of each node, or −1
};

}  // namespace deformlab
