#pragma once

#include "solvers/gauss_newton/linearization/linearization.h"
#include "solvers/gauss_newton/step_solvers/step_solver.h"
#include "solvers/summary.h"

namespace deformlab {

/// The current iterate x of a solve, with F and Jᵀr there, a direction δ, and a trial point
/// x + s δ. Globalizations compute directions and try steps through it; the driver then accepts the
/// last trial point as the new x.
class Iterate {
 public:
  Iterate(const Problem& problem, Linearization& linearization, StepSolver& steps);

  /// Starts a solve at problem.x. The summary counts the work.
  void start(Problem& problem, Summary& summary);
  /// Makes the last trial point the new x and linearizes there. Returns false, and goes back to the
  /// old x, if F or its gradient is not finite there.
  bool accept();
  /// Whether F and its gradient are finite at x.
  bool finite() const;
  /// The last point that was tried.
  const Unknowns& trial() const { return trial_; }

  double cost() const { return cost_; }  ///< F at x
  /// Jᵀr at x, half of ∇F, n.
  const Eigen::VectorXd& gradient() const { return linearization_.Jtr(); }
  /// A bound on the rounding errors of F: a smaller change of F means nothing.
  double rounding() const;

  /// Solves (JᵀJ + λ diag(D)) δ = −Jᵀr, where λ is the damping and D the diagonal of JᵀJ, limited
  /// to a range. Returns false if the matrix is singular.
  bool compute_direction(double damping);
  /// The same. If the matrix is singular, because some motion changes no term, it is damped just
  /// enough to be regular, and δ is a short one of all solutions.
  bool compute_regular_direction(double damping);
  /// The direction δ, which a globalization may change.
  Eigen::VectorXd& delta() { return delta_; }
  /// The D that the last damped direction was computed with.
  const Eigen::VectorXd& D() const { return D_; }

  /// Prepares steps along δ. It has to be called whenever δ has changed, before `try_step`.
  void set_direction() { linearization_.set_direction(delta_); }
  /// The slope of F along δ at x.
  double slope() const { return 2 * gradient().dot(delta_); }
  /// Makes x + scale · δ the trial point and returns F there.
  double try_step(double scale);
  /// The scale of the step to the trial point; 0 if this point does not lie along δ.
  double tried() const { return tried_; }
  /// Notes that the trial point does not lie along δ any more.
  void forget_trial() { tried_ = 0; }
  /// Whether a step of this length that leads to this cost lowers F enough, compared with what the
  /// slope promises (Armijo's rule).
  bool sufficient(double cost, double scale, double slope) const;

  /// Computes a correction c: δ + c follows the curvature of the residuals (geodesic acceleration,
  /// Transtrum and Sethna 2012). The trial point has to be x + δ. Returns false if there is no c.
  bool compute_geodesic_correction(Eigen::VectorXd& c);

 private:
  bool count(const StepResult& result);

  Linearization& linearization_;
  StepSolver& steps_;
  Unknowns* x_ = nullptr;
  Summary* summary_ = nullptr;
  Unknowns trial_;
  Eigen::VectorXd delta_, D_, second_order_;
  double cost_ = 0, tried_ = 0;
};

}  // namespace deformlab
