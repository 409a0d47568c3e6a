#pragma once

#include <ceres/problem.h>

#include <memory>
#include <vector>

#include "solvers/solver.h"

namespace deformlab {

/// The same terms through ceres::Problem, one parameter block a node, one residual block an
/// element. The problem is built in `compile` and kept; constant derivatives are computed once,
/// there.
class CeresSolver final : public Solver {
 public:
  explicit CeresSolver(const SolverOptions& options);
  void compile(const Stage& stage) override;
  Summary solve(Stage& stage) override;

 private:
  SolverOptions options_;
  std::unique_ptr<ceres::Problem> problem_;
  Unknowns x_;  // the problem's parameter blocks live here
  std::vector<char> used_;
};

}  // namespace deformlab
