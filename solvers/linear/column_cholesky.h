#pragma once

#include <cstddef>
#include <vector>

#include "geometry/core/workers.h"
#include "solvers/linear/column_block.h"
#include "solvers/linear/factor_branches.h"

namespace deformlab {

/// A Cholesky factor A = L Lᵀ of a sparse positive definite matrix, laid out for solves with four
/// right-hand sides at once: up to four columns of L that have the same rows below them lie side by
/// side in a panel, row after row. A solve then reads L as one stream.
class ColumnCholesky {
 public:
  /// Factors the matrix of this lower triangle, whose rows are in a fill-reducing order already
  /// (column_order) and which has every entry of its diagonal. False where it is singular in double
  /// precision or not positive definite.
  bool factorize(const SparseMatrix& lower);
  /// z = A⁻¹ b by the last factorization, which must have succeeded. Large factors are solved with
  /// branch by branch, in the same way however many workers there are.
  void solve(const ColumnBlock& b, ColumnBlock& z, Workers& workers);
  /// Entries of the panels.
  long nonzeros() const { return static_cast<long>(values_.size()); }

  struct Panel {
    int first, width;           // columns
    int rows;                   // below its triangle
    std::size_t index, values;  // where its rows and entries begin
  };

 private:
  struct Workspace;

  void find_panels(const SparseMatrix& lower);
  void sort_rows(int n);
  void place_values();
  bool compute(const SparseMatrix& lower);
  void load(const SparseMatrix& lower, const Panel& panel, Workspace& w) const;
  void subtract(int q, const Panel& panel, Workspace& w) const;
  bool finish(const Panel& panel, Workspace& w);
  void branch_out();
  double* apart(std::size_t branch) { return z_.data() + 4 * (n_ + branch * top_.size()); }
  void forward(const std::vector<FactorBranches::Range>& ranges);
  void backward(const std::vector<FactorBranches::Range>& ranges);

  std::vector<Panel> panels_;
  std::vector<int> rows_;
  // Of each panel its lower triangle row by row, with the inverse of the diagonal, then the rows.
  std::vector<double> values_;
  // What branches add to the columns above them is kept apart, one copy of these a branch, behind
  // the n columns of a right-hand side: there a branch's rows_ point.
  FactorBranches branches_;
  std::vector<int> top_;
  std::size_t n_ = 0;
  ColumnBlock z_;
};

}  // namespace deformlab
