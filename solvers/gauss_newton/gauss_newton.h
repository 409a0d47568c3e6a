#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "solvers/gauss_newton/globalization/globalization.h"
#include "solvers/gauss_newton/iterate.h"
#include "solvers/gauss_newton/linearization/linearization.h"
#include "solvers/gauss_newton/step_solvers/step_solver.h"
#include "solvers/solver.h"

namespace deformlab {

/// Gauss–Newton on sparse normal equations (Sumner et al. 2007, Eq. 10–12). It owns the
/// linearization of the problem; a step solver computes directions from it, and a globalization
/// chooses the steps.
class GaussNewton final : public Solver {
 public:
  /// Throws InputError for an unknown linear solver or globalization.
  explicit GaussNewton(const SolverOptions& options);

  void compile(const Problem& problem) override;
  bool change_elements(const Problem& problem, std::size_t term) override;
  Summary solve(Problem& problem) override;

 private:
  void start(Problem& problem);
  std::pair<Status, std::string> run();
  std::string culprit(const Problem& problem, Status status) const;
  Summary finish(const Problem& problem, Status status, std::string message);

  SolverOptions options_;
  std::unique_ptr<StepSolver> steps_;
  std::unique_ptr<Globalization> globalization_;
  // `compile` makes these two.
  std::optional<Linearization> linearization_;
  std::optional<Iterate> iterate_;
  Summary summary_;
};

}  // namespace deformlab
