#pragma once

#include <Eigen/Core>
#include <memory>

#include "solvers/linear/sparse_matrix.h"

namespace deformlab {

/// A direct solver for H δ = b with a symmetric positive definite H, which is given by its lower
/// triangle. The order and the structure are found once, and the numbers change with every
/// factorization.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// A fill-reducing order: row and column order[i] of `lower` should come to position i. The
  /// values of the entries do not matter. The default implementation keeps the given order.
  ///   group  every `group` consecutive rows have almost the same neighbours and may be kept
  ///          together
  ///   quick  whether nested dissection is tried only if minimum degree causes much fill
  virtual Eigen::VectorXi order(const SparseMatrix& lower, int group = 1, bool quick = false);
  /// Symbolic factorization of a matrix that is in a fill-reducing order already.
  virtual void analyze(const SparseMatrix& lower) = 0;
  /// Numeric factorization of a matrix that has the structure which was analyzed. Returns false if
  /// a pivot is not positive, or less than kSingularRatio of the largest.
  virtual bool factorize(const SparseMatrix& lower) = 0;
  /// δ = H⁻¹ b by the last factorization, which must have succeeded.
  virtual void solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) = 0;
  /// The number of nonzeros in the factor.
  virtual long nonzeros() const = 0;
  /// The number of threads that it uses.
  virtual int threads() const { return 1; }
};

/// If the smallest pivot of a factor is less than this share of the largest, the matrix counts as
/// singular in double precision.
inline constexpr double kSingularRatio = 1e-14;

/// Makes a CholmodSolver for code that does not include the headers of CHOLMOD.
std::unique_ptr<LinearSolver> make_cholmod(int threads = 1);

}  // namespace deformlab
