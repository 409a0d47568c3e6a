#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solvers/gauss_newton/step_solvers/normal_matrix.h"
#include "solvers/gauss_newton/step_solvers/step_solver.h"

namespace deformlab {

/// Computes directions by factoring JᵀJ in each step, as the paper does. The order and the symbolic
/// factorization are found once for each compilation.
class DirectSteps final : public StepSolver {
 public:
  ///   name  of the linear solver
  DirectSteps(std::string name, std::unique_ptr<LinearSolver> solver)
      : name_(std::move(name)), solver_(std::move(solver)) {}

  void compile(const Linearization& linearization) override;
  void update(const Linearization& linearization) override;
  StepResult direction(const Linearization& linearization, double damping, const Eigen::VectorXd& D,
                       Eigen::VectorXd& delta) override;
  StepResult geodesic_correction(const Linearization& linearization, const Eigen::VectorXd& q,
                                 Eigen::VectorXd& c) override;
  std::string name() const override { return name_; }
  long nonzeros_JtJ(const Linearization&) const override;
  long nonzeros_factor() const override;
  int threads() const override { return solver_->threads(); }

 private:
  bool factorize(double damping, const Eigen::VectorXd& D);
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta, StepResult& result);

  std::string name_;
  std::unique_ptr<LinearSolver> solver_;
  std::optional<NormalMatrix> matrix_;  // none if there is no unknown
  SparseMatrix damped_;                 // H + λ D
  std::vector<int> diagonal_;           // the index of each unknown's diagonal among H's values
  Eigen::VectorXd b_, x_;               // a right-hand side and a solution in the order of H
};

}  // namespace deformlab
