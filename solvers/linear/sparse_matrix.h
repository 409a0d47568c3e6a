#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace deformlab {

/// The type of sparse matrices. A symmetric matrix is given by its lower triangle, with rows in
/// ascending order in every column.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// One entry of a sparse matrix.
struct SparseEntry {
  int row, column;
  double value;
};

/// The n×n matrix of these entries, no two of which may have the same row and column. The time is
/// linear in their number.
SparseMatrix sparse_matrix(const std::vector<SparseEntry>& entries, int n);

}  // namespace deformlab
