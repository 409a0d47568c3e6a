#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "solvers/gauss_newton/step_solver.h"
#include "solvers/solver.h"

namespace deformlab {

/// Gauss–Newton on sparse normal equations (Sumner et al. 2007, Eq. 10–12; damping after Madsen,
/// Nielsen and Tingleff 2004). Order and symbolic factorization are found in `compile` and kept.
class GaussNewton final : public Solver {
 public:
  explicit GaussNewton(const SolverOptions& options);
  void compile(const Problem& problem) override;
  Summary solve(Problem& problem) override;

 private:
  enum class Outcome { kAccepted, kUphill, kNotFinite, kSingular };

  Outcome advance(Problem& problem, Iteration& iteration);
  Outcome full_step(Problem& problem, Iteration& iteration);
  Outcome line_search(Problem& problem, Iteration& iteration);
  Outcome accelerated(Problem& problem, Iteration& iteration);
  void conjugate();
  void find_length(const Problem& problem, double slope, Iteration& iteration);
  void adapt_damping(double length);
  bool bend(const Problem& problem, Iteration& iteration);
  Outcome levenberg(Problem& problem, Iteration& iteration);
  bool newton_direction(const Problem& problem, double given = 0);
  double try_step(const Problem& problem, double scale);
  bool direction(const Problem& problem, double damping);
  void measure_diagonal();
  void fall_back(const Problem& problem);
  void use(const std::string& linear_solver, const Problem& problem);
  void start(Problem& problem);
  std::pair<Status, std::string> iterate(Problem& problem);
  Summary finish(const Problem& problem, Status status, std::string message);

  SolverOptions options_;
  std::unique_ptr<StepSolver> steps_;
  Choice choice_;
  Eigen::VectorXd delta_, D_;
  // Of `accelerated`: the direction by Gauss–Newton and the gradient it came from, then the last.
  Eigen::VectorXd newton_, gradient_, last_newton_, last_gradient_, last_delta_, q_, c_;
  Unknowns trial_;
  double tried_ = 0;  // the length of the step to trial_
  double cost_ = 0, damping_ = 0, damping_growth_ = 2;
  bool conjugate_ = false, bends_ = true;
  Summary summary_;
};

}  // namespace deformlab
