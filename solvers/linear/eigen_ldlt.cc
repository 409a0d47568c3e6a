#include "solvers/linear/eigen_ldlt.h"

#include <Eigen/OrderingMethods>

namespace deformlab {

Eigen::VectorXi EigenLdlt::order(const SparseMatrix& lower, int, bool) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), permutation);
  return permutation.indices();
}

bool EigenLdlt::factorize(const SparseMatrix& lower) {
  ldlt_.factorize(lower);
  if (ldlt_.info() != Eigen::Success) return false;
  nonzeros_ = ldlt_.matrixL().nestedExpression().nonZeros();
  const auto D = ldlt_.vectorD();
  return D.minCoeff() > kSingularRatio * D.maxCoeff();
}

}  // namespace deformlab
