#include "deformers/baselines/prism_solver.h"

#include <cmath>
#include <utility>

#include "solvers/linear/blas.h"
#include "solvers/solver.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kSufficientDecrease = 1e-4;  // of E [decrease that the slope predicts]
constexpr double kSmallestStep = 1e-6;
constexpr double kRounding = 1e-13;      // a smaller increase of E does not count [1 + E]
constexpr double kLeastDamping = 1e-12;  // regularizes components that are pinned at one point

class Descent {
 public:
  Descent(PrismEquations& equations, RigidMotions& motions, Summary& summary)
      : equations_(equations),
        motions_(motions),
        trial_(motions),
        summary_(summary),
        cost_(equations.energy(motions)) {
    summary_.initial_cost = cost_;
  }

  std::pair<Status, std::string> iterate(double epsilon, int max_iterations) {
    if (!std::isfinite(cost_)) return {Status::kFailed, "E is not finite at the start"};
    if (equations_.unknowns() == 0) return {Status::kConverged, "every prism is fixed"};
    linearize();
    for (int k = 0; k < max_iterations; ++k) {
      Iteration iteration;
      Stopwatch watch(iteration.seconds);
      if (!find_direction(iteration)) {
        return {Status::kFailed, "the Hessian cannot be factorized, however damped"};
      }
      if (!step(iteration)) return {Status::kStalled, "no step along the direction lowers E"};
      linearize();
      iteration.gradient_max = equations_.gradient_max();
      iteration.seconds = watch.elapsed();
      summary_.iterations.push_back(iteration);
      const double previous = std::exchange(cost_, iteration.cost);
      if (converged(cost_, previous, iteration.gradient_max, iteration.step_max, epsilon)) {
        return {Status::kConverged, "the three conditions of Eq. 12 hold"};
      }
    }
    return {Status::kMaxIterations, "Eq. 12 does not hold after max_iterations steps"};
  }

 private:
  void linearize() {
    Stopwatch watch(summary_.seconds["linearize"]);
    equations_.linearize(motions_);
  }

  bool find_direction(Iteration& iteration) {
    Stopwatch watch(summary_.seconds["factorize"]);
    iteration.damping = kLeastDamping;
    ++summary_.factorizations;
    if (equations_.solve(true, iteration.damping, velocities_)) return true;
    for (; iteration.damping < 1; iteration.damping *= 100) {
      ++summary_.factorizations;
      if (equations_.solve(false, iteration.damping, velocities_)) return true;
    }
    return false;
  }

  bool step(Iteration& iteration) {
    Stopwatch watch(summary_.seconds["evaluate"]);
    const double slope = 2 * equations_.slope(velocities_);
    for (double scale = 1; scale >= kSmallestStep; scale /= 2) {
      move(motions_, velocities_, scale, trial_);
      iteration.cost = equations_.energy(trial_);
      iteration.step_scale = scale;
      iteration.step_max = scale * velocities_.lpNorm<Eigen::Infinity>();
      const double enough = cost_ + kSufficientDecrease * scale * slope + kRounding * (1 + cost_);
      if (!(iteration.cost <= enough)) continue;
      std::swap(motions_, trial_);
      return true;
    }
    return false;
  }

  PrismEquations& equations_;
  RigidMotions& motions_;
  RigidMotions trial_;
  Summary& summary_;
  double cost_;
  Eigen::MatrixXd velocities_;
};

}  // namespace

Summary minimize(PrismEquations& equations, RigidMotions& motions, double epsilon,
                 int max_iterations) {
  Summary summary;
  summary.method = "primo";
  summary.linear_solver = "cholmod";
  summary.globalization = "line_search";
  summary.blas = blas_name();
  summary.unknowns = equations.unknowns();
  {
    Stopwatch watch(summary.seconds["total"]);
    Descent descent(equations, motions, summary);
    std::tie(summary.status, summary.message) = descent.iterate(epsilon, max_iterations);
  }
  summary.cost_by_term["joints"] = equations.joint_energy(motions);
  summary.cost_by_term["handles"] = equations.pin_energy(motions);
  summary.final_cost = equations.energy(motions);
  if (summary.unknowns > 0) {
    summary.nonzeros_JtJ = equations.H().nonZeros();
    summary.nonzeros_factor = equations.nonzeros_factor();
  }
  return summary;
}

}  // namespace deformlab
