#include "tests/support/sparse_system.h"

namespace deformlab::test {

Eigen::SparseMatrix<double> SparseSystem::JtJ() const { return J.transpose() * J; }

Eigen::VectorXd SparseSystem::Jtr() const { return J.transpose() * r; }

SparseSystem sparse_system(const std::vector<WeightedTerm>& terms, const Unknowns& x) {
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

}  // namespace deformlab::test
