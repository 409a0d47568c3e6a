#pragma once

#include <memory>

#include "solvers/gauss_newton/linearization/element_derivatives.h"

namespace deformlab {

/// A term whose derivative changes: it is nonlinear, or it has a loss ρ.
///
/// With a loss, r and J of each element are scaled by √ρ′ of the last linearization, as Ceres does
/// where ρ″ ≤ 0. Then Jᵀr is half of ∇F, and JᵀJ leaves out what ρ″ would subtract.
class NonlinearPart {
 public:
  NonlinearPart(const WeightedEnergy& term, const Unknowns& x, const FreeColumns& columns);

  /// Returns w E at x, and keeps the residuals for `linearize`.
  double cost(const Unknowns& x);
  /// Computes J at x, where the cost was computed last, and adds w Jᵀr to Jtr.
  void linearize(const Unknowns& x, Eigen::VectorXd& Jtr);
  /// Adds w Jᵀ (r(x + δ) − r(x) − J δ) to q, where x is what was linearized last, and the cost was
  /// computed last at x + δ.
  ///   scratch  memory for as many numbers as an element reads
  void add_second_order(const Unknowns& x, const Eigen::VectorXd& delta, Eigen::VectorXd& q,
                        double* scratch);

  const ElementDerivatives& derivatives() const { return derivatives_; }
  /// √ρ′ of every element. J is scaled by it already. Empty without a loss.
  const Eigen::VectorXd& root() const { return root_; }

 private:
  void multiply_transposed(Eigen::MatrixXd& Jtr) const;

  std::shared_ptr<const ceres::LossFunction> loss_;
  ElementDerivatives derivatives_;
  Eigen::MatrixXd r_;             // rows × elements
  Eigen::VectorXd root_;          // √ρ′ of every element
  Eigen::MatrixXd second_order_;  // width × elements
};

}  // namespace deformlab
