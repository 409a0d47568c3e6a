#pragma once

#include "solvers/linear/cholmod_workspace.h"
#include "solvers/linear/linear_solver.h"

namespace deformlab {

/// CHOLMOD's supernodal Cholesky factorization. Its order is that of METIS or AMD, whichever causes
/// less fill. A quick order is that of AMD, unless it causes much fill.
class CholmodSolver final : public LinearSolver {
 public:
  explicit CholmodSolver(int threads = 1);
  ~CholmodSolver() override;
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  Eigen::VectorXi order(const SparseMatrix& lower, int group, bool quick) override;
  void analyze(const SparseMatrix& lower) override;
  bool factorize(const SparseMatrix& lower) override;
  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& delta) override;
  long nonzeros() const override;
  int threads() const override { return threads_; }

 private:
  Eigen::VectorXi take(cholmod_factor* factor);

  int threads_;
  CholmodWorkspace cholmod_;
  cholmod_factor* L_ = nullptr;
  // Results and workspace of cholmod_solve2, which reuses them from solve to solve.
  cholmod_dense *x_ = nullptr, *Y_ = nullptr, *E_ = nullptr;
};

}  // namespace deformlab
