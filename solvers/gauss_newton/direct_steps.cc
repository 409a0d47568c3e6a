#include "solvers/gauss_newton/direct_steps.h"

#include <algorithm>

#include "solvers/stopwatch.h"

namespace deformlab {

void DirectSteps::compile(const Problem& problem) {
  equations_ = std::make_unique<NormalEquations>(problem);
  const int n = equations_->unknowns();
  if (n == 0) return;
  // Ordered by columns of X. By nodes, or with the columns of R eliminated before those of t, the
  // factor fills more: 3.4 and 1.2 times as much at 1,048 nodes of the reference scene. METIS takes
  // 40 % of the compilation to fill no less than AMD there, and 2 % less at 4,000 nodes.
  equations_->arrange(solver_->order(equations_->structure(), problem.x.dimension(), true));
  solver_->analyze(equations_->H());
  damped_ = equations_->H();
  diagonal_.resize(n);
  for (int c = 0; c < n; ++c) diagonal_[c] = damped_.outerIndexPtr()[c];  // lower: first in column
}

bool DirectSteps::factorize(double damping, const Eigen::VectorXd& D) {
  Stopwatch watch(work.factorize_seconds);
  ++work.factorizations;
  const SparseMatrix& H = equations_->H();
  if (damping == 0) return solver_->factorize(H);
  std::copy_n(H.valuePtr(), H.nonZeros(), damped_.valuePtr());
  for (Eigen::Index i = 0; i < D.size(); ++i) damped_.valuePtr()[diagonal_[i]] += damping * D[i];
  return solver_->factorize(damped_);
}

bool DirectSteps::direction(double damping, const Eigen::VectorXd& D, Eigen::VectorXd& delta) {
  return factorize(damping, D) && correction(equations_->Jtr(), delta);
}

bool DirectSteps::correction(const Eigen::VectorXd& q, Eigen::VectorXd& c) {
  Stopwatch watch(work.solve_seconds);
  solver_->solve(q, c);
  c = -c;
  return c.allFinite();
}

void DirectSteps::diagonal(Eigen::VectorXd& D) const {
  for (Eigen::Index i = 0; i < D.size(); ++i) D[i] = equations_->H().valuePtr()[diagonal_[i]];
}

long DirectSteps::nonzeros_factor() const {
  return equations_->unknowns() > 0 ? solver_->nonzeros() : 0;
}

}  // namespace deformlab
