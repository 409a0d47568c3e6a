#include "solvers/gauss_newton/iterate.h"

#include <cmath>
#include <utility>

#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kSufficientDecrease = 1e-4;  // as a share of what the slope promises
constexpr double kRounding = 1e-13;           // of 1 + F, as in Eq. 12
constexpr double kRegularization = 1e-10;     // the least relative damping of a singular JᵀJ
constexpr double kLeastD = 1e-6, kMostD = 1e32;

}  // namespace

Iterate::Iterate(const Problem& problem, Linearization& linearization, StepSolver& steps)
    : linearization_(linearization), steps_(steps), trial_(problem.x) {
  for (Eigen::VectorXd* x : {&delta_, &D_, &second_order_}) x->setZero(linearization.unknowns());
}

void Iterate::start(Problem& problem, Summary& summary) {
  x_ = &problem.x;
  summary_ = &summary;
  trial_.X = problem.x.X;  // with the fixed nodes
  linearization_.set_targets();
  cost_ = linearization_.evaluate(problem.x);
  if (!std::isfinite(cost_)) return;
  linearization_.linearize(problem.x);
  if (finite()) steps_.update(linearization_);
}

bool Iterate::accept() {
  Stopwatch watch(summary_->seconds["linearize"]);
  std::swap(x_->X, trial_.X);
  cost_ = linearization_.linearize_step(*x_);
  if (!finite()) {
    std::swap(x_->X, trial_.X);
    return false;
  }
  steps_.update(linearization_);
  return true;
}

bool Iterate::finite() const { return std::isfinite(cost_) && gradient().allFinite(); }

double Iterate::rounding() const { return kRounding * (1 + cost_); }

bool Iterate::sufficient(double cost, double scale, double slope) const {
  return cost <= cost_ + kSufficientDecrease * scale * slope + rounding();
}

// Adds the work to the summary. Returns whether there is a direction.
bool Iterate::count(const StepResult& result) {
  summary_->factorizations += result.factorizations;
  summary_->cg_iterations += result.cg_iterations;
  summary_->seconds["factorize"] += result.factorize_seconds;
  summary_->seconds["solve"] += result.solve_seconds;
  if (!result.note.empty()) summary_->notes.push_back(result.note);
  return result.regular;
}

bool Iterate::compute_direction(double damping) {
  if (damping > 0) {
    steps_.diagonal(linearization_, D_);
    D_ = D_.cwiseMax(kLeastD).cwiseMin(kMostD);
  }
  return count(steps_.direction(linearization_, damping, D_, delta_));
}

bool Iterate::compute_regular_direction(double damping) {
  if (compute_direction(damping)) return true;
  steps_.diagonal(linearization_, D_);
  const double largest = D_.maxCoeff();
  D_.setConstant(largest > 0 ? largest : 1);
  bool regular = false;
  for (double added = kRegularization; !regular && added < 1; added *= 100) {
    regular = count(steps_.direction(linearization_, added, D_, delta_));
  }
  if (summary_->notes.empty()) {
    summary_->notes.emplace_back(
        "JᵀJ is singular, because some motion changes no term, so the steps are damped");
  }
  return regular;
}

double Iterate::try_step(double scale) {
  Stopwatch watch(summary_->seconds["evaluate"]);
  tried_ = scale;
  linearization_.step(*x_, delta_, scale, trial_);
  return linearization_.evaluate_step(trial_, scale);
}

bool Iterate::compute_geodesic_correction(Eigen::VectorXd& c) {
  linearization_.second_order(*x_, delta_, second_order_);
  return count(steps_.geodesic_correction(linearization_, second_order_, c)) && c.allFinite();
}

}  // namespace deformlab
