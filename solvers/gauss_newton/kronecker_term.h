#pragma once

#include <Eigen/Core>

#include "solvers/linear/column_block.h"

namespace deformlab {

/// A Kronecker term, whose elements have the residuals r_e = X a_e − b_e.
struct KroneckerTerm {
  const Eigen::MatrixXd& a;  ///< n × elements
  const ColumnBlock& b;      ///< 4 × elements
  const int* column;         ///< n × elements: the columns of X that a_e stands for
};

/// E = Σ_e ‖r_e‖² at X, all columns by four.
double energy(const KroneckerTerm& term, const ColumnBlock& X);

/// The same, and G += weight · Σ_e r_e a_eᵀ, half of weight · ∂E/∂X.
double energy(const KroneckerTerm& term, const ColumnBlock& X, double weight, ColumnBlock& G);

}  // namespace deformlab
