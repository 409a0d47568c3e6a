#pragma once

#include <Eigen/Core>
#include <vector>

#include "solvers/gauss_newton/linearization/free_columns.h"
#include "solvers/gauss_newton/linearization/low_rank_change.h"
#include "solvers/linear/column_block.h"

namespace deformlab {

/// A Kronecker term, whose elements have the residuals r_e = X a_e − b_e. The coefficients a are
/// constant, and b changes with the targets.
class KroneckerPart {
 public:
  KroneckerPart(const WeightedEnergy& term, const FreeColumns& columns);

  /// Reads the current targets of the energy.
  void set_targets();

  /// w E at X, which has all columns, also those of fixed nodes.
  double cost(const ColumnBlock& X) const;
  /// The same, and adds w Σ_e r_e a_eᵀ to G, which is half of w ∂E/∂X.
  double cost(const ColumnBlock& X, ColumnBlock& G) const;

  const Energy& energy() const { return *energy_; }
  double weight() const { return weight_; }
  /// a, one column for each element.
  const Eigen::MatrixXd& coefficients() const { return a_; }

  /// The elements that only one of two sums of the same term has. The elements are compared by the
  /// columns that they read and by their coefficients.
  struct Difference {
    std::vector<int> removed, added;  ///< elements of the old sum, and of the new one
  };
  Difference difference_to(const KroneckerPart& next) const;
  /// What element e multiplies with the free columns, in the order of their ranks.
  std::vector<LowRankChange::Entry> free_coefficients(int e, const FreeColumns& columns) const;

 private:
  bool same(int e, const KroneckerPart& other, int f) const;

  const Energy* energy_;
  double weight_;
  Eigen::MatrixXd a_;        // n × elements
  Eigen::MatrixXd offsets_;  // d × elements: b as the energy gives it
  ColumnBlock b_;            // 4 × elements
  std::vector<int> column_;  // n × elements: the columns of X that the coefficients belong to
};

}  // namespace deformlab
