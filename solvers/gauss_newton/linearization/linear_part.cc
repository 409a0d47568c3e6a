#include "solvers/gauss_newton/linearization/linear_part.h"

namespace deformlab {

LinearPart::LinearPart(const WeightedEnergy& term, const Unknowns& x, const FreeColumns& columns)
    : derivatives_(term, x, columns, term.energy->arity() == 1),
      r_(term.energy->rows(), term.energy->size()) {}

double LinearPart::cost(const Unknowns& x) {
  derivatives_.energy().residuals(x, r_.data());
  return derivatives_.weight() * squared_sum(r_, nullptr);
}

void LinearPart::linearize(const Unknowns& x, Eigen::VectorXd& Jtr) {
  if (derivatives_.squared()) {
    derivatives_.compute(x);
  } else {
    derivatives_.multiply_transposed(r_, derivatives_.Jtr());
  }
  derivatives_.add(derivatives_.Jtr(), Jtr);
}

}  // namespace deformlab
