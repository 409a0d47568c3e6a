#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// The unknowns of one problem: nodes side by side in one matrix with d rows. Each node owns a few
/// consecutive columns. In embedded deformation d = 3 and a node has four columns, R_j and t_j; in
/// a triangulated drawing d = 2 and a node has one column, the vertex. One problem may have nodes
/// with different numbers of columns.
struct Unknowns {
  Eigen::MatrixXd X;          ///< d × number of columns
  std::vector<int> first{0};  ///< node j owns the columns first[j] … first[j+1] − 1

  int dimension() const { return static_cast<int>(X.rows()); }
  int nodes() const { return static_cast<int>(first.size()) - 1; }
  int columns(int j) const { return first[j + 1] - first[j]; }
  const double* node(int j) const { return X.data() + X.rows() * first[j]; }

  /// m nodes with the same number of columns, side by side in X.
  static Unknowns uniform(Eigen::MatrixXd X, int m) {
    Unknowns x{std::move(X), {}};
    const int columns = m > 0 ? static_cast<int>(x.X.cols()) / m : 0;
    for (int j = 0; j <= m; ++j) x.first.push_back(j * columns);
    return x;
  }
};

}  // namespace deformlab
