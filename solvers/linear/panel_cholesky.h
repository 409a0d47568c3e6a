#pragma once

#include <Eigen/SparseCore>
#include <complex>
#include <cstddef>
#include <vector>

namespace deformlab {

/// A Cholesky factor A = L Lᴴ of a sparse positive definite matrix, real or Hermitian, laid out for
/// solves with one complex right-hand side, such as x + iy of the points of a drawing: up to four
/// columns of L that have the same rows below them lie side by side in a panel, row after row. A
/// solve then reads L as one stream, and each row of a panel touches the right-hand side once.
///   Scalar  double or std::complex<double>
template <class Scalar>
class PanelCholesky {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar, Eigen::ColMajor, int>;

  /// Factors the matrix of this lower triangle, whose rows are in a fill-reducing order already
  /// (LinearSolver::order) and which has every entry of its diagonal. False where it is singular in
  /// double precision or not positive definite.
  bool factorize(Matrix lower);
  /// z ← A⁻¹ z by the last factorization, which must have succeeded. Allocates nothing.
  void solve(Eigen::VectorXcd& z) const;
  /// Entries of the panels.
  long nonzeros() const { return static_cast<long>(values_.size()); }

 private:
  struct Panel {
    int first, width;           // columns
    int rows;                   // below its triangle
    std::size_t index, values;  // where its rows and entries begin
  };
  struct Column;

  static bool joins(int width, const Column* columns);
  void add_panel(int first, int width, const Column* columns);
  template <int width>
  void forward(const Panel& panel, double* z) const;
  template <int width>
  void backward(const Panel& panel, double* z) const;

  std::vector<Panel> panels_;
  std::vector<int> rows_;
  // Of each panel its lower triangle row by row, with the inverse of the diagonal, then the rows.
  std::vector<Scalar> values_;
};

extern template class PanelCholesky<double>;
extern template class PanelCholesky<std::complex<double>>;

}  // namespace deformlab
