#pragma once

#include <Eigen/SparseCore>

namespace deformlab {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Columns of X by four entries each, those beyond the d-th being zero: four at a time is what
/// processors add best.
using ColumnBlock = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Σ of the products of all entries.
double dot(const ColumnBlock& x, const ColumnBlock& y);

/// y += s x.
void add_scaled(double s, const ColumnBlock& x, ColumnBlock& y);

/// y = x + s y.
void add_to_scaled(const ColumnBlock& x, double s, ColumnBlock& y);

/// y += (A ⊗ I) x for the symmetric matrix whose lower triangle is given, with all of its diagonal
/// and rows in ascending order.
void add_product(const SparseMatrix& lower, const ColumnBlock& x, ColumnBlock& y);

}  // namespace deformlab
