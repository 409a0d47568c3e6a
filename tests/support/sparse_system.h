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

  Eigen::SparseMatrix<double> JtJ() const { return J.transpose() * J; }
  Eigen::VectorXd Jtr() const { return J.transpose() * r; }
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

inline SparseSystem sparse_system(const std::vector<WeightedTerm>& terms, const Unknowns& x) {
  std::vector<double> residuals;
  std::vector<Eigen::Triplet<double>> triplets;
  for (const WeightedTerm& term : terms) {
    const Energy* energy = term.energy;
    Eigen::VectorXd r(energy->rows());
    Eigen::MatrixXd J(energy->rows(), energy->jacobian_columns());
    for (int e = 0; e < energy->size(); ++e) {
      std::vector<const double*> at;
      for (const int node : energy->nodes(e)) at.push_back(x.node(node));
      energy->evaluate(e, at.data(), r.data(), J.data());
      const double scale = term.scale(r);
      const int row = static_cast<int>(residuals.size());
      for (int a = 0, column = 0; a < energy->arity(); ++a) {
        const int first = x.first[energy->nodes(e)[a]] * x.dimension();
        for (int i = 0; i < energy->dimension() * energy->argument(a).count; ++i, ++column) {
          for (int l = 0; l < energy->rows(); ++l) {
            triplets.emplace_back(row + l, first + i, scale * J(l, column));
          }
        }
      }
      for (const double value : r) residuals.push_back(scale * value);
    }
  }
  SparseSystem system{Eigen::Map<Eigen::VectorXd>(residuals.data(), std::ssize(residuals)), {}};
  system.J.resize(system.r.size(), x.X.size());
  system.J.setFromTriplets(triplets.begin(), triplets.end());
  return system;
}

/// ‖a − b‖ over the larger of ‖a‖ and ‖b‖ (and 0 where both vanish).
template <class A, class B>
double relative_difference(const A& a, const B& b) {
  const double size = std::max(a.norm(), b.norm());
  return size > 0 ? (a - b).norm() / size : 0;
}

}  // namespace deformlab::test
