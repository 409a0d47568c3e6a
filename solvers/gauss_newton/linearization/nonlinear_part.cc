#include "solvers/gauss_newton/linearization/nonlinear_part.h"

#include <cmath>

namespace deformlab {

NonlinearPart::NonlinearPart(const WeightedEnergy& term, const Unknowns& x,
                             const FreeColumns& columns)
    : loss_(term.loss),
      derivatives_(term, x, columns, !term.loss && term.energy->arity() == 1),
      r_(term.energy->rows(), term.energy->size()),
      second_order_(derivatives_.width(), term.energy->size()) {
  if (loss_) root_.setOnes(term.energy->size());
}

double NonlinearPart::cost(const Unknowns& x) {
  derivatives_.energy().residuals(x, r_.data());
  return derivatives_.weight() * squared_sum(r_, loss_.get());
}

// Computes Jᵀr of every element. J is scaled by √ρ′ already, and r is not.
void NonlinearPart::multiply_transposed(Eigen::MatrixXd& Jtr) const {
  derivatives_.multiply_transposed(r_, Jtr);
  for (Eigen::Index e = 0; e < root_.size(); ++e) Jtr.col(e) *= root_[e];
}

void NonlinearPart::linearize(const Unknowns& x, Eigen::VectorXd& Jtr) {
  derivatives_.compute(x);
  if (loss_) {
    for (Eigen::Index e = 0; e < r_.cols(); ++e) {
      root_[e] = std::sqrt(loss_slope(*loss_, r_.col(e).squaredNorm()));
    }
    derivatives_.scale(root_);
  }
  if (!derivatives_.squared()) multiply_transposed(derivatives_.Jtr());
  derivatives_.add(derivatives_.Jtr(), Jtr);
}

void NonlinearPart::add_second_order(const Unknowns& x, const Eigen::VectorXd& delta,
                                     Eigen::VectorXd& q, double* scratch) {
  if (derivatives_.squared()) {
    derivatives_.energy().transposed_products(x, r_.data(), second_order_.data());
  } else {
    multiply_transposed(second_order_);
  }
  second_order_ -= derivatives_.Jtr();
  derivatives_.subtract_JtJ(delta, second_order_, scratch);
  derivatives_.add(second_order_, q);
}

}  // namespace deformlab
