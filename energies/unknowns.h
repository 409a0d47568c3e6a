#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// The unknowns of one problem: nodes side by side in one matrix of d rows, each node owning a few
/// consecutive columns. Embedded deformation has d = 3 and four columns a node, R_j and t_j; a
/// triangulated drawing has d = 2 and one column, the vertex. Nodes of several kinds may be mixed.
struct Unknowns {
  Eigen::MatrixXd X;          ///< d × number of columns
  std::vector<int> first{0};  ///< node j owns the columns first[j] … first[j+1] − 1

  int dimension() const { return static_cast<int>(X.rows()); }
  int nodes() const { return static_cast<int>(first.size()) - 1; }
  int columns(int j) const { return first[j + 1] - first[j]; }
  const double* node(int j) const { return X.data() + X.rows() * first[j]; }

  /// m nodes of equally many columns, side by side in X.
  static Unknowns uniform(Eigen::MatrixXd X, int m) {
    Unknowns x{std::move(X), {}};
    const int columns = m > 0 ? static_cast<int>(x.X.cols()) / m : 0;
    for (int j = 0; j <= m; ++j) x.first.push_back(j * columns);
    return x;
  }
};

}  // namespace deformlab
