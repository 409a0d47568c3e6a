#include "solvers/stage.h"

namespace deformlab {

double cost(const Stage& stage, const Unknowns& x) {
  double sum = 0;
  for (const auto& [energy, weight] : stage.terms) {
    Eigen::VectorXd r(energy->rows() * energy->size());
    energy->residuals(x, r.data());
    sum += weight * r.squaredNorm();
  }
  return sum;
}

}  // namespace deformlab
