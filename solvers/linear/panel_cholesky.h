#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <cstddef>
#include <vector>

#include "solvers/linear/column_block.h"

namespace deformlab {

/// A column of few entries.
using SparseColumn = Eigen::SparseVector<std::complex<double>>;

/// A Cholesky factor A = L Lᴴ of a sparse positive definite matrix, real or Hermitian. It is made
/// for very many solves with few right-hand sides: up to four columns of L that have almost the
/// same rows are stored as one panel, row by row, so that a solve reads L from begin to end, and
/// each row of a panel accesses the right-hand sides once.
///   Scalar  double or std::complex<double>
template <class Scalar>
class PanelCholesky {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar, Eigen::ColMajor, int>;

  /// Factors A. Returns false if A is not positive definite, or so close to singular that the
  /// smallest pivot is less than kSingularRatio of the largest.
  ///   lower  the lower triangle of A, with every entry of the diagonal. Its rows have to be in a
  ///          fill-reducing order already.
  bool factorize(const Matrix& lower);

  /// z ← A⁻¹ z for one complex right-hand side, such as x + iy of the points of a drawing. All
  /// solves need a factorization that succeeded, and allocate nothing where they work in place.
  void solve(Eigen::VectorXcd& z) const {
    solve_lower(z);
    solve_upper(z);
  }
  /// The two halves of it: z ← L⁻¹ z and z ← L⁻ᴴ z.
  void solve_lower(Eigen::VectorXcd& z) const;
  void solve_upper(Eigen::VectorXcd& z) const;
  /// L⁻¹ b for a right-hand side of few entries. Its time does not grow with the whole factor, but
  /// with the part of it that b reaches.
  ///   zeros  as many zeros as A has rows, which the solve uses and leaves at 0
  SparseColumn solve_lower(const SparseColumn& b, Eigen::VectorXcd& zeros) const;
  /// Z ← (A⁻¹ ⊗ I) Z for four real right-hand sides. For real matrices only.
  void solve(ColumnBlock& Z) const;

  /// The number of entries in the panels.
  long nonzeros() const { return static_cast<long>(values_.size()); }

  struct Panel {
    int first, width;           ///< its columns of L
    int rows;                   ///< the number of rows below its triangle
    std::size_t index, values;  ///< where its rows and its entries begin
  };

 private:
  struct Workspace;

  void find_panels(const Matrix& lower);
  void sort_rows(int n);
  void lay_out_values();
  bool compute(const Matrix& lower);
  void load(const Matrix& lower, const Panel& panel, Workspace& w) const;
  void subtract(int q, const Panel& panel, Workspace& w) const;
  bool finish(const Panel& panel, Workspace& w);

  std::vector<Panel> panels_;
  std::vector<int> panel_of_;  // of each column
  std::vector<int> rows_;
  // For each panel its lower triangle, row by row and with an inverted diagonal, then its rows.
  std::vector<Scalar> values_;
};

template <>
void PanelCholesky<double>::solve(ColumnBlock& Z) const;

extern template class PanelCholesky<double>;
extern template class PanelCholesky<std::complex<double>>;

}  // namespace deformlab
