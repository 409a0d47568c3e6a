#pragma once

#include <memory>
#include <vector>

#include "solvers/gauss_newton/node_squares.h"
#include "solvers/gauss_newton/step_solver.h"
#include "solvers/linear/panel_cholesky.h"

namespace deformlab {

/// Directions by conjugate gradients on the exact JᵀJ, which is never assembled. The preconditioner
/// is Ã ⊗ I_d, the nearest such matrix to JᵀJ in the Frobenius norm at the state that was compiled:
/// the Kronecker terms are A ⊗ I_d already, of the others each d×d block counts by its mean
/// diagonal. Ã has a d²-th of JᵀJ's entries and is factored once per compilation; a solve with it
/// takes all d coordinates of a column at once.
class KroneckerCg final : public StepSolver {
 public:
  void compile(const Problem& problem) override;
  Linearization& linearization() override { return *linearization_; }
  /// Inexact: iterates until another iteration would gain little.
  bool direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) override;
  bool correction(const Eigen::VectorXd& q, Eigen::VectorXd& c) override { return solve(q, 0, c); }
  void diagonal(Eigen::VectorXd& D) const override;
  long nonzeros_JtJ() const override { return linearization_->A().nonZeros(); }
  long nonzeros_factor() const override { return L_.nonzeros(); }
  double condition() const override;
  void probe() override;

 private:
  static constexpr int kMostMeasured = 32;  // iterations

  void factorize();
  bool solve(const Eigen::VectorXd& gradient, double damping, Eigen::VectorXd& delta);
  bool iterate(double damping, double forcing, int most);
  void multiply(double damping);
  void multiply_part(const Linearization::Part& part);

  std::unique_ptr<Linearization> linearization_;
  NodeSquares squares_;      // the terms that read one node each
  PanelCholesky<double> L_;  // of Ã, which stands in M = Ã ⊗ I_d
  bool factored_ = false;    // not where Ã is not finite
  SparseMatrix minus_C_;     // A − Ã, lower triangle
  ColumnBlock r_, z_, p_, Mp_, Hp_, delta_, D_;
  // Of the last solve's first iterations: the diagonal and what is beside it of the tridiagonal
  // matrix that has about the eigenvalues of the preconditioned one.
  Eigen::VectorXd diagonal_{kMostMeasured}, beside_{kMostMeasured};
  Eigen::Index measured_ = 0;
  std::vector<double> local_;  // an element's share of a block
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxResiduals, 1> local_t_{
      kMaxResiduals};
};

}  // namespace deformlab
