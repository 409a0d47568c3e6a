#pragma once

#include "solvers/ceres/ceres_solver.h"
#include "solvers/gauss_newton/step_solvers/normal_matrix.h"
#include "solvers/linear/sparse_matrix.h"
#include "tests/support/problems.h"

// The rungs on which the two paths are compared, for any problem.
namespace deformlab::test {

/// r, J and the gradient of Ceres' sample at x, over the free entries.
struct CeresSystem {
  Eigen::VectorXd r, gradient;
  Eigen::SparseMatrix<double> J;
};

CeresSystem ceres_system(const Problem& problem, const Unknowns& x, CeresBlocks blocks);

/// H and Jᵀr of the normal equations in the order of the free entries.
struct NormalSystem {
  Eigen::SparseMatrix<double> H;
  Eigen::VectorXd Jtr;
};

/// The order that a matrix has.
Eigen::VectorXi as_given(const SparseMatrix& lower);

NormalSystem normal_system(const Problem& problem, const Unknowns& x, bool reordered);

/// Rung 1: r, J, JᵀJ and Jᵀr agree at x.
void expect_same_system(const Problem& problem, const Unknowns& x);

/// Rung 2: one full step is the dense solution of JᵀJ δ = −Jᵀr.
void expect_dense_step(Problem& problem, const Unknowns& x, const std::string& linear_solver);

/// Rung 3: under the same globalization both end in the same minimum.
void expect_same_minimum(Problem& problem, const SolverOptions& one, const SolverOptions& other);

}  // namespace deformlab::test
