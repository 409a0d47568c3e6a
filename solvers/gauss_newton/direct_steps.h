#pragma once

#include <memory>
#include <vector>

#include "solvers/gauss_newton/normal_equations.h"
#include "solvers/gauss_newton/step_solver.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {

/// Directions by a factorization of JᵀJ in each step, the paper's way: order and symbolic
/// factorization are found once per compilation.
class DirectSteps final : public StepSolver {
 public:
  explicit DirectSteps(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}

  void compile(const Problem& problem) override;
  Linearization& linearization() override { return *equations_; }
  bool direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) override;
  bool correction(const Eigen::VectorXd& q, Eigen::VectorXd& c) override;
  void diagonal(Eigen::VectorXd& D) const override;
  long nonzeros_JtJ() const override { return equations_->H().nonZeros(); }
  long nonzeros_factor() const override;

 private:
  bool factorize(double damping, const Eigen::VectorXd& D);

  std::unique_ptr<LinearSolver> solver_;
  std::unique_ptr<NormalEquations> equations_;
  SparseMatrix damped_;        // H + λ D
  std::vector<int> diagonal_;  // places of H's diagonal among its values
};

}  // namespace deformlab
