#pragma once

#include <Eigen/Core>
#include <vector>

#include "solvers/linearization.h"

namespace deformlab {

/// The normal equations JᵀJ δ = −Jᵀr of a stage with H = JᵀJ as one sparse matrix. Its constant
/// share, all but the nonlinear terms', is assembled once.
class NormalEquations final : public Linearization {
 public:
  explicit NormalEquations(const Stage& stage);

  /// Puts unknown order[i] in place i, for a fill-reducing order of H's rows and columns.
  void reorder(const Eigen::VectorXi& order);

  /// JᵀJ where the stage was linearized last, n×n, lower triangle.
  const SparseMatrix& H() const { return H_; }

 protected:
  void linearized() override;

 private:
  using Triplets = std::vector<Eigen::Triplet<double>>;

  void assemble_structure();
  void find_targets();
  template <class Visit>
  void for_each_pair(const Part& part, int e, Visit&& visit) const;
  void add_JtJ(const Part& part, const std::vector<int>& targets);

  SparseMatrix H_;
  Eigen::VectorXd constant_;  // H's values without the nonlinear terms
  // Of each nonlinear part: index into H's values of each pair of an element.
  std::vector<std::vector<int>> targets_;
};

}  // namespace deformlab
