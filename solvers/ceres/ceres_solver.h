#pragma once

#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "solvers/ceres/trouble.h"
#include "solvers/solver.h"

namespace deformlab {

/// Minimises a problem with Ceres Solver. Each element becomes a residual block over the parameter
/// blocks that options.ceres_blocks describes. `compile` builds the ceres::Problem, which all
/// solves use, and computes the constant derivatives.
class CeresSolver final : public Solver {
 public:
  explicit CeresSolver(const SolverOptions& options);
  void compile(const Problem& problem) override;
  Summary solve(Problem& problem) override;

  /// The ceres::Problem that `compile` built, and the unknowns that its parameter blocks point to.
  ceres::Problem& problem() { return *problem_; }
  Unknowns& x() { return x_; }

 private:
  void add(const WeightedEnergy& term, bool by_column);

  SolverOptions options_;
  Trouble trouble_;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;  // the problem refers to them
  std::unique_ptr<ceres::Problem> problem_;
  Unknowns x_;             // the problem's parameter blocks are here
  std::size_t terms_ = 0;  // their number in the compiled problem
};

}  // namespace deformlab
