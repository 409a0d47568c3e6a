#pragma once

#include <Eigen/Core>

#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

/// Columns of X, padded with zeros from d to four entries each, because processors add and multiply
/// four numbers at once.
using ColumnBlock = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Copies the unknowns x, d for each column, into the first d rows of a block.
void gather(const Eigen::VectorXd& x, int d, ColumnBlock& block);
/// Copies the first d rows of a block into the unknowns x.
void scatter(const ColumnBlock& block, int d, Eigen::VectorXd& x);

/// The sum of the products of all entries, ⟨x, y⟩.
double dot(const ColumnBlock& x, const ColumnBlock& y);

/// y += s x.
void add_scaled(double s, const ColumnBlock& x, ColumnBlock& y);

/// y = x + s y.
void add_to_scaled(const ColumnBlock& x, double s, ColumnBlock& y);

/// y += (A ⊗ I) x for a symmetric matrix A that has every entry of its diagonal.
///   lower  the lower triangle of A
void add_product(const SparseMatrix& lower, const ColumnBlock& x, ColumnBlock& y);

}  // namespace deformlab
