#pragma once

#include <vector>

#include "solvers/problem.h"

namespace deformlab {

/// The columns of X whose nodes are not fixed, and the numbering of the unknowns: each free column
/// has a rank, and its d entries are the unknowns d·rank to d·rank + d − 1.
class FreeColumns {
 public:
  /// The ranks follow the order of the columns in X.
  explicit FreeColumns(const Problem& problem);

  int dimension() const { return dimension_; }                    ///< d
  int columns() const { return static_cast<int>(rank_.size()); }  ///< all columns of X
  int count() const { return count_; }                            ///< the free ones
  int unknowns() const { return dimension_ * count_; }            ///< n

  /// The rank of a column of X, or −1 if its node is fixed.
  int rank(int column) const { return rank_[column]; }
  const std::vector<int>& ranks() const { return rank_; }
  /// The unknown that is an entry of X, or −1 if its node is fixed.
  int unknown(int row, int column) const {
    return rank_[column] < 0 ? -1 : dimension_ * rank_[column] + row;
  }
  /// The first column of each node, and the number of columns at the end.
  const std::vector<int>& first() const { return first_; }

  /// Gives rank i to the column that has rank order[i].
  void reorder(const std::vector<int>& order);

 private:
  int dimension_;
  int count_ = 0;
  std::vector<int> first_, rank_;
};

/// The columns of X that each element of an energy reads, its arguments in turn.
std::vector<int> columns_read(const Energy& energy, const FreeColumns& columns);

/// How many columns of X one element reads.
inline int columns_of_element(const Energy& energy) {
  return energy.jacobian_columns() / energy.dimension();
}

}  // namespace deformlab
