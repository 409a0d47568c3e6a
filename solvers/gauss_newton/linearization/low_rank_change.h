#pragma once

#include <Eigen/Core>
#include <vector>

#include "solvers/linear/column_block.h"
#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

/// How A has changed since it was assembled: the sum of s_i u_i u_iᵀ over elements of Kronecker
/// terms that were added (s_i = w) or removed (s_i = −w).
class LowRankChange {
 public:
  /// With a greater rank, steps become so slow that assembling A again pays.
  static constexpr int kMostRank = 8;

  struct Entry {
    int rank;      ///< of a free column
    double value;  ///< that of u_i
  };
  struct Vector {
    double s;
    std::vector<Entry> u;
  };

  /// Adds s u uᵀ. If it takes back an earlier change, both vanish.
  void add(double s, std::vector<Entry> u);

  const std::vector<Vector>& vectors() const { return vectors_; }
  int rank() const { return static_cast<int>(vectors_.size()); }
  /// How many of the vectors have s < 0.
  int negative() const;

  /// y += (Σ s_i u_i u_iᵀ ⊗ I) x.
  void add_product(const ColumnBlock& x, ColumnBlock& y) const;
  /// The lower triangle of the sum over n free columns.
  SparseMatrix lower(int n) const;

 private:
  std::vector<Vector> vectors_;
};

/// uᵀ x for a vector u over the free columns, for all coordinates of x at once.
Eigen::Vector4d product(const std::vector<LowRankChange::Entry>& u, const ColumnBlock& x);

}  // namespace deformlab
