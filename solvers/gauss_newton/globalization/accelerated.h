#pragma once

#include "solvers/gauss_newton/globalization/globalization.h"

namespace deformlab {

/// Gauss–Newton steps in conjugate directions of interpolated length, with geodesic acceleration.
/// Each step
///   1. makes Gauss–Newton's direction conjugate to the last one, by Polak and Ribière's formula
///      for nonlinear conjugate gradients with JᵀJ as the preconditioner (Nocedal and Wright 2006,
///      section 5.2);
///   2. finds a length along it, at the minimum of the parabola through F, its slope, and F at the
///      last length that was tried (Nocedal and Wright 2006, section 3.5);
///   3. if F falls much less than promised, tries the full step with geodesic acceleration, which
///      follows the curvature of the residuals (Transtrum and Sethna 2012);
///   4. damps the next direction if only a small part of this one could be taken.
class Accelerated final : public Globalization {
 public:
  void start(int unknowns) override;
  Outcome advance(Iterate& iterate, Iteration& step) override;

 private:
  void make_conjugate(Iterate& iterate);
  void find_length(Iterate& iterate, double slope, Iteration& step) const;
  bool try_geodesic_step(Iterate& iterate, Iteration& step);
  void adapt_damping(double length);

  double damping_ = 0;
  bool conjugate_ = false;  // whether the next direction can be made conjugate to the last one
  bool geodesic_ = true;    // whether geodesic acceleration helped when it was last tried
  Eigen::VectorXd newton_, gradient_;  // Gauss–Newton's direction and Jᵀr
  Eigen::VectorXd last_newton_, last_gradient_, last_delta_;  // and those of the last step
  Eigen::VectorXd correction_;
};

}  // namespace deformlab
