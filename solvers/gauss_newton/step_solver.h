#pragma once

#include <Eigen/Core>
#include <memory>

#include "solvers/gauss_newton/linearization.h"
#include "solvers/options.h"

namespace deformlab {

/// What the linear algebra of a solve cost.
struct LinearWork {
  int factorizations = 0;
  int cg_iterations = 0;
  int unfinished = 0;  ///< solves that conjugate gradients gave up
  double factorize_seconds = 0;
  double solve_seconds = 0;
};

/// Computes Gauss–Newton directions of a problem, (JᵀJ + λ diag(D)) δ = −Jᵀr, and corrections.
class StepSolver {
 public:
  virtual ~StepSolver() = default;

  /// What depends on the structure of the problem alone. Called before anything else.
  virtual void compile(const Problem& problem) = 0;
  /// The linearization that directions are computed from; the caller evaluates and linearizes it.
  virtual Linearization& linearization() = 0;
  /// δ at what was linearized last. False where the matrix is singular in double precision.
  ///   D  n, used where damping > 0.
  virtual bool direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) = 0;
  /// c = −(JᵀJ)⁻¹ q where δ was computed last, without damping.
  virtual bool correction(const Eigen::VectorXd& q, Eigen::VectorXd& c) = 0;
  /// The diagonal of JᵀJ.
  virtual void diagonal(Eigen::VectorXd& D) const = 0;
  /// Nonzeros of JᵀJ's lower triangle as it is kept, and of the factor.
  virtual long nonzeros_JtJ() const = 0;
  virtual long nonzeros_factor() const = 0;
  /// Of the preconditioned matrix, as the last direction or probe showed it; 0 where there is none.
  virtual double condition() const { return 0; }
  /// Takes a few iterations where the problem was compiled, to learn the condition.
  virtual void probe() {}

  LinearWork work;
};

/// "kronecker_cg" where the terms suit it, else "cholmod"; says why.
struct Choice {
  std::string name, reason;
};
Choice choose_step_solver(const Problem& problem);

/// name: "cholmod", "eigen_ldlt" or "kronecker_cg". Throws InputError for another.
std::unique_ptr<StepSolver> make_step_solver(const std::string& name, int threads = 1);

}  // namespace deformlab
