#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solvers/gauss_newton/linearization/linearization.h"
#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

/// H = JᵀJ of a linearization, assembled as one sparse matrix in an order of its own. Only the part
/// of the nonlinear terms changes. The structure is found for the columns of X and then extended to
/// their coordinates, so that the time is linear in the number of elements.
class NormalMatrix {
 public:
  /// Finds an order for a matrix, as LinearSolver::order does.
  using Ordering = std::function<Eigen::VectorXi(const SparseMatrix& lower)>;

  /// `update` computes the values of H.
  NormalMatrix(const Linearization& linearization, const Ordering& ordering);

  /// Assembles H where the problem was linearized last.
  void update(const Linearization& linearization);

  /// n×n, lower triangle.
  const SparseMatrix& H() const { return H_; }
  /// The row and the column of H for each unknown.
  const std::vector<int>& position() const { return position_; }

 private:
  SparseMatrix pattern(const SparseMatrix& uncoupled, const SparseMatrix& coupled, int d) const;
  template <class Visit>
  void for_each_pair(const Linearization& linearization, const ElementDerivatives& part, int e,
                     Visit&& visit) const;
  void find_targets(const Linearization& linearization);
  void add_JtJ(const Linearization& linearization, std::size_t part);

  std::vector<int> position_;
  SparseMatrix H_;
  Eigen::VectorXd constant_;  // H's values without the nonlinear terms
  // For each of the linearization's derivatives, and for each pair of entries of each element: the
  // index of the pair among H's values.
  std::vector<std::vector<int>> targets_;
};

}  // namespace deformlab
