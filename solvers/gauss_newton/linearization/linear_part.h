#pragma once

#include "solvers/gauss_newton/linearization/element_derivatives.h"

namespace deformlab {

/// A linear term, whose elements have the residuals r_e = J_e x − b_e with a constant J.
class LinearPart {
 public:
  LinearPart(const WeightedEnergy& term, const Unknowns& x, const FreeColumns& columns);

  /// Returns w E at x, and keeps the residuals for `linearize`.
  double cost(const Unknowns& x);
  /// Adds w Jᵀr at x, where the cost was computed last, to Jtr.
  void linearize(const Unknowns& x, Eigen::VectorXd& Jtr);

  const ElementDerivatives& derivatives() const { return derivatives_; }

 private:
  ElementDerivatives derivatives_;
  Eigen::MatrixXd r_;  // rows × elements
};

}  // namespace deformlab
