#pragma once

#include <memory>
#include <string>

#include "solvers/gauss_newton/step_solvers/direct_steps.h"
#include "solvers/gauss_newton/step_solvers/kronecker_cg.h"
#include "solvers/gauss_newton/step_solvers/step_solver.h"

namespace deformlab {

/// Conjugate gradients (KroneckerCg) if the structure of the terms suits them and the estimated
/// condition number is moderate, and a factorization by CHOLMOD otherwise. If conjugate gradients
/// do not converge, all later steps are factored too, until the next compilation.
class AutoSteps final : public StepSolver {
 public:
  explicit AutoSteps(int threads) : threads_(threads) {}

  ColumnOrder prepare(const Problem& problem) override;
  void compile(const Linearization& linearization) override;
  bool change_elements(const Linearization& linearization) override {
    return chosen().change_elements(linearization);
  }
  void update(const Linearization& linearization) override { chosen().update(linearization); }
  StepResult direction(const Linearization& linearization, double damping, const Eigen::VectorXd& D,
                       Eigen::VectorXd& delta) override;
  StepResult geodesic_correction(const Linearization& linearization, const Eigen::VectorXd& q,
                                 Eigen::VectorXd& c) override;
  std::string name() const override { return chosen().name(); }
  std::string reason() const override { return reason_; }
  long nonzeros_JtJ(const Linearization& linearization) const override {
    return chosen().nonzeros_JtJ(linearization);
  }
  long nonzeros_factor() const override { return chosen().nonzeros_factor(); }
  double condition() const override { return chosen().condition(); }
  int threads() const override { return chosen().threads(); }

 private:
  StepSolver& chosen() const;
  void use_conjugate_gradients(std::string reason);
  void use_factorization(std::string reason);

  int threads_;
  std::string reason_;
  bool unfinished_ = false;                 // some solve by conjugate gradients did not converge
  std::unique_ptr<KroneckerCg> iterative_;  // one of the two is null
  std::unique_ptr<DirectSteps> direct_;
};

}  // namespace deformlab
