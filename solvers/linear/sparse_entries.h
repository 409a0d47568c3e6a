#pragma once

#include <vector>

#include "solvers/linear/column_block.h"

namespace deformlab {

/// An entry of a sparse matrix, of which there is one a place.
struct SparseEntry {
  int row, column;
  double value;
};

/// The n×n matrix of these entries, in ascending rows, in a time linear in them.
SparseMatrix sparse_matrix(const std::vector<SparseEntry>& entries, int n);

}  // namespace deformlab
