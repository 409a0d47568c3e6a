#pragma once

#include <Eigen/SparseCore>

namespace deformlab {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Columns of X by four entries each, those beyond the d-th being zero: four at a time is what
/// processors add best.
using Columns4 = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Σ of the products of all entries.
double dot(const Columns4& x, const Columns4& y);

/// y += s x.
void add_scaled(double s, const Columns4& x, Columns4& y);

/// y = x + s y.
void add_to_scaled(const Columns4& x, double s, Columns4& y);

/// y += (A ⊗ I) x for the symmetric matrix whose lower triangle is given, with all of its diagonal
/// and rows in ascending order.
void add_product(const SparseMatrix& lower, const Columns4& x, Columns4& y);

}  // namespace deformlab
