#pragma once

#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "solvers/solver.h"

namespace deformlab {

/// The same terms through ceres::Problem, one residual block an element, over the parameter blocks
/// that options.ceres_blocks names. The problem is built in `compile` and kept; constant
/// derivatives are computed once, there.
class CeresSolver final : public Solver {
 public:
  explicit CeresSolver(const SolverOptions& options);
  void compile(const Problem& problem) override;
  Summary solve(Problem& problem) override;

  /// What `compile` built, and the state that its parameter blocks point into, node after node.
  ceres::Problem& problem() { return *problem_; }
  Unknowns& x() { return x_; }

 private:
  void add(const WeightedEnergy& term, bool by_column);

  SolverOptions options_;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;  // that the problem refers to
  std::unique_ptr<ceres::Problem> problem_;
  Unknowns x_;  // the problem's parameter blocks live here
};

}  // namespace deformlab
