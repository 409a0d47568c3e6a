#pragma once

#include <memory>
#include <string>

#include "solvers/gauss_newton/linearization.h"

namespace deformlab {

/// A direct solver for H δ = b with symmetric positive definite H, given by its lower triangle.
/// Order and structure are found once, the numbers change with every factorization.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// A fill-reducing order: row and column order[i] of `lower` should come to place i.
  /// Entries may be zero, their places count. Every `group` consecutive rows have almost the same
  /// neighbours and may be kept together. A quick order tries nested dissection only where minimum
  /// degree fills much.
  virtual Eigen::VectorXi order(const SparseMatrix& lower, int group = 1, bool quick = false) = 0;
  /// Symbolic factorization of a matrix that is already in a good order.
  virtual void analyze(const SparseMatrix& lower) = 0;
  /// Numeric factorization of a matrix of the structure that was analyzed. False where a pivot is
  /// not positive, or so small beside the others that the matrix is singular in double precision.
  virtual bool factorize(const SparseMatrix& lower) = 0;
  /// δ = H⁻¹ b by the last factorization, which must have succeeded.
  virtual void solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) = 0;
  /// Nonzeros of the factor.
  virtual long nonzeros() const = 0;
};

/// Below this ratio of the factor's smallest to its largest pivot a matrix counts as singular.
inline constexpr double kSingularRatio = 1e-14;

/// name: "cholmod" or "eigen_ldlt". Throws InputError for another. CHOLMOD may use more threads.
std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, int threads = 1);

}  // namespace deformlab
