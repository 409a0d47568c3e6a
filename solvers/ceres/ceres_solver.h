#pragma once

#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "solvers/solver.h"

namespace deformlab {

/// Minimises the same terms with Ceres Solver: one residual block for each element, over the
/// parameter blocks that options.ceres_blocks names. `compile` builds the ceres::Problem, which is
/// kept, and computes the derivatives that are constant.
class CeresSolver final : public Solver {
 public:
  explicit CeresSolver(const SolverOptions& options);
  void compile(const Problem& problem) override;
  Summary solve(Problem& problem) override;

  /// The ceres::Problem that `compile` built, and the state that its parameter blocks point into,
  /// node after node.
  ceres::Problem& problem() { return *problem_; }
  Unknowns& x() { return x_; }

 private:
  void add(const WeightedEnergy& term, bool by_column);

  SolverOptions options_;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;  // the problem refers to them
  std::unique_ptr<ceres::Problem> problem_;
  Unknowns x_;             // the problem's parameter blocks are here
  std::size_t terms_ = 0;  // of the problem that was compiled
};

}  // namespace deformlab
