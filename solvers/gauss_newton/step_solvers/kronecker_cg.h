#pragma once

#include <string>
#include <vector>

#include "solvers/gauss_newton/step_solvers/step_solver.h"
#include "solvers/linear/panel_cholesky.h"

namespace deformlab {

/// Computes directions by conjugate gradients on the exact H = JᵀJ, which is never assembled. The
/// preconditioner M = Ã ⊗ I_d is the matrix of this form that is nearest to JᵀJ, in the Frobenius
/// norm, at the state of the compilation. The Kronecker terms have this form, A ⊗ I_d, already; of
/// the others Ã has the mean of the diagonal of each d×d block. Ã is factored once for each
/// compilation, and a solve with it handles all d coordinates of a column at once.
class KroneckerCg final : public StepSolver {
 public:
  /// Throws InputError if no term is Kronecker.
  ColumnOrder prepare(const Problem& problem) override;
  void compile(const Linearization& linearization) override;
  /// Corrects the solves with Ã by the formula of Sherman, Morrison and Woodbury.
  bool change_elements(const Linearization& linearization) override;
  /// The result is inexact: iterations end when another one would gain little.
  StepResult direction(const Linearization& linearization, double damping, const Eigen::VectorXd& D,
                       Eigen::VectorXd& delta) override;
  StepResult geodesic_correction(const Linearization& linearization, const Eigen::VectorXd& q,
                                 Eigen::VectorXd& c) override;
  std::string name() const override { return "kronecker_cg"; }
  long nonzeros_JtJ(const Linearization& linearization) const override {
    return linearization.A().nonZeros();
  }
  long nonzeros_factor() const override { return L_.nonzeros(); }
  double condition() const override;

  /// An estimate of the condition number of the preconditioned matrix where the problem was
  /// linearized last, from a few iterations; 0 if there is no unknown.
  double estimate_condition(const Linearization& linearization);

 private:
  static constexpr int kMostMeasured = 32;  // iterations

  void factorize(const Linearization& linearization);
  StepResult solve(const Linearization& linearization, const Eigen::VectorXd& gradient,
                   double damping, Eigen::VectorXd& delta);
  StepResult iterate(const Linearization& linearization, double damping, double forcing, int most);
  void precondition(const Linearization& linearization);
  void multiply(const Linearization& linearization, double damping);

  PanelCholesky<double> L_;  // of Ã
  bool factored_ = false;    // false if Ã is not finite
  SparseMatrix minus_C_;     // A − Ã, lower triangle
  // A has changed by Σ s u uᵀ = U S Uᵀ since: Y = Ã⁻¹ U, transposed, and (S⁻¹ + Uᵀ Y)⁻¹.
  static constexpr int kMostRank = LowRankChange::kMostRank;
  Eigen::MatrixXd Yt_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRank, kMostRank>
      capacitance_inverse_;
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, kMostRank> projected_;
  ColumnBlock r_, z_, p_, Mp_, Hp_, delta_, D_;
  // The diagonal of a tridiagonal matrix, and the entries beside it, from the first iterations of
  // the last solve. Its extreme eigenvalues are about those of the preconditioned matrix.
  Eigen::VectorXd diagonal_{kMostMeasured}, beside_{kMostMeasured};
  Eigen::Index measured_ = 0;
  std::vector<double> scratch_;  // for the numbers that an element reads
};

}  // namespace deformlab
