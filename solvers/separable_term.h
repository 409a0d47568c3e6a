#pragma once

#include <Eigen/Core>

#include "solvers/columns4.h"

namespace deformlab {

/// A separable term, whose elements have the residuals r_e = X a_e − b_e.
struct SeparableTerm {
  const Eigen::MatrixXd& a;  ///< n × elements
  const Columns4& b;         ///< 4 × elements
  const int* column;         ///< n × elements: the columns of X that a_e stands for
};

/// E = Σ_e ‖r_e‖² at X, all columns by four.
double energy(const SeparableTerm& term, const Columns4& X);

/// The same, and G += weight · Σ_e r_e a_eᵀ, half of weight · ∂E/∂X.
double energy(const SeparableTerm& term, const Columns4& X, double weight, Columns4& G);

}  // namespace deformlab
