#pragma once

#include <ceres/loss_function.h>

#include <Eigen/SparseCore>
#include <array>
#include <cmath>
#include <vector>

#include "energies/energy.h"

namespace deformlab::test {

/// Residuals and Jacobian of weighted terms, those of a term with a loss times √ρ′, written down
/// without any of the solvers' shortcuts: the reference that they are compared with. Columns are
/// the entries of X as they are stored.
struct SparseSystem {
  Eigen::VectorXd r;
  Eigen::SparseMatrix<double> J;

  Eigen::SparseMatrix<double> JtJ() const;
  Eigen::VectorXd Jtr() const;
};

struct WeightedTerm {
  const Energy* energy;
  double weight = 1;
  const ceres::LossFunction* loss = nullptr;

  /// What an element's residual and Jacobian are multiplied with.
  double scale(const Eigen::VectorXd& r) const {
    std::array<double, 3> rho{0, 1, 0};
    if (loss) loss->Evaluate(r.squaredNorm(), rho.data());
    return std::sqrt(weight * rho[1]);
  }
};

SparseSystem sparse_system(const std::vector<WeightedTerm>& terms, const Unknowns& x);

/// ‖a − b‖ over the larger of ‖a‖ and ‖b‖ (and 0 where both vanish).
template <class A, class B>
double relative_difference(const A& a, const B& b) {
  const double size = std::max(a.norm(), b.norm());
  return size > 0 ? (a - b).norm() / size : 0;
}

}  // namespace deformlab::test
