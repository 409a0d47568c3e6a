#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "solvers/solver.h"
#include "solvers/step_solver.h"

namespace deformlab {

/// Gauss–Newton on sparse normal equations (Sumner et al. 2007, Eq. 10–12; damping after Madsen,
/// Nielsen and Tingleff 2004). Order and symbolic factorization are found in `compile` and kept.
class GaussNewton final : public Solver {
 public:
  explicit GaussNewton(const SolverOptions& options);
  void compile(const Stage& stage) override;
  Summary solve(Stage& stage) override;

 private:
  enum class Outcome { kAccepted, kUphill, kNotFinite, kSingular };

  Outcome advance(Stage& stage, Iteration& iteration);
  Outcome full_step(Stage& stage, Iteration& iteration);
  Outcome line_search(Stage& stage, Iteration& iteration);
  Outcome accelerated(Stage& stage, Iteration& iteration);
  void conjugate();
  void find_length(const Stage& stage, double slope, Iteration& iteration);
  void adapt_damping(double length);
  bool bend(const Stage& stage, Iteration& iteration);
  Outcome levenberg(Stage& stage, Iteration& iteration);
  bool newton_direction(const Stage& stage, double given = 0);
  double try_step(const Stage& stage, double scale);
  bool direction(const Stage& stage, double damping);
  void measure_diagonal();
  void fall_back(const Stage& stage);
  void use(const std::string& linear_solver, const Stage& stage);
  void start(Stage& stage);
  std::pair<Status, std::string> iterate(Stage& stage);
  Summary finish(const Stage& stage, Status status, std::string message);

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
