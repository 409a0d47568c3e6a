#pragma once

#include <Eigen/SparseCholesky>

#include "solvers/linear/linear_solver.h"

namespace deformlab {

/// Eigen's simplicial LDLᵀ factorization. It uses neither BLAS nor supernodes, and serves as an
/// independent check of CHOLMOD.
class EigenLdlt final : public LinearSolver {
 public:
  Eigen::VectorXi order(const SparseMatrix& lower, int group, bool quick) override;
  void analyze(const SparseMatrix& lower) override { ldlt_.analyzePattern(lower); }
  bool factorize(const SparseMatrix& lower) override;
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) override { delta = ldlt_.solve(b); }
  long nonzeros() const override { return nonzeros_; }

 private:
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt_;
  long nonzeros_ = 0;  // Eigen does not know this before the first factorization
};

}  // namespace deformlab
