#include "solvers/linear/linear_solver.h"

namespace deformlab {

Eigen::VectorXi LinearSolver::order(const SparseMatrix& lower, int, bool) {
  return Eigen::VectorXi::LinSpaced(lower.cols(), 0, static_cast<int>(lower.cols()) - 1);
}

}  // namespace deformlab
