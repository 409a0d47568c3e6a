#pragma once

#include <Eigen/Core>
#include <vector>

#include "solvers/gauss_newton/linearization.h"
#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

/// The normal equations JᵀJ δ = −Jᵀr of a problem with H = JᵀJ as one sparse matrix, of which only
/// the nonlinear terms' share changes. Its structure is found column by column of X, and what two
/// columns have in common is spread over their coordinates: in a time linear in the elements.
class NormalEquations final : public Linearization {
 public:
  explicit NormalEquations(const Problem& problem);

  /// Where H may differ from 0, n×n, lower triangle, the unknowns as they come.
  SparseMatrix structure() const;
  /// Makes H with unknown order[i] in place i; called before anything is evaluated, once.
  void arrange(const Eigen::VectorXi& order);

  /// JᵀJ where the problem was linearized last, n×n, lower triangle.
  const SparseMatrix& H() const { return H_; }

 protected:
  void linearized() override;

 private:
  void find_targets();
  template <class Visit>
  void for_each_pair(const Part& part, int e, Visit&& visit) const;
  void add_JtJ(std::size_t part);

  SparseMatrix full_;  // pairs of columns that have all d² entries; the others have but d
  SparseMatrix H_;
  Eigen::VectorXd constant_;  // H's values without the nonlinear terms
  // Of each part that is not Kronecker: index into H's values of each pair of an element.
  std::vector<std::vector<int>> targets_;
};

}  // namespace deformlab
