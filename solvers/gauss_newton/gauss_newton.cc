#include "solvers/gauss_newton/gauss_newton.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "geometry/core/error.h"
#include "solvers/linear/blas.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

constexpr double kSufficientDecrease = 1e-4;  // of F, as a share of what the slope promises
constexpr double kSmallestStep = 1e-6;
constexpr double kShort = 0.25, kLong = 0.75, kShortDamping = 1e-3;
constexpr double kPoor = 0.25;  // share of what a step promised: less, and it is bent
constexpr double kMostConjugate = 5, kDescent = 0.1;
constexpr double kMostCondition = 1e5;  // that conjugate gradients are tried on
constexpr int kMostLengths = 4;         // that are tried of one direction
constexpr double kSameLength = 0.1;
constexpr double kFirstDamping = 1e-4, kLeastDamping = 1e-16, kMostDamping = 1e16;
constexpr double kRegularization = 1e-10;  // relative, of a singular JᵀJ
constexpr double kRounding = 1e-13;        // of 1 + F, as in Eq. 12: less is not uphill

// Conjugate gradients are preconditioned by the terms that declare themselves Kronecker.
void check_kronecker(const Problem& problem) {
  std::string names;
  for (const WeightedEnergy& term : problem.terms) {
    if (term.structure() == Structure::kKronecker) return;
    names += (names.empty() ? "" : ", ") + std::string(term.energy->name());
  }
  if (names.empty()) return;
  throw InputError("solver.linear_solver is kronecker_cg, but of the terms (" + names +
                   ") none is Kronecker; use auto, cholmod or eigen_ldlt");
}

}  // namespace

GaussNewton::GaussNewton(const SolverOptions& options) : options_(options) {
  if (options.linear_solver != "auto") make_step_solver(options.linear_solver);  // or throws
}

void GaussNewton::compile(const Problem& problem) {
  check(problem);
  if (options_.linear_solver == "kronecker_cg") check_kronecker(problem);
  choice_ = {options_.linear_solver, ""};
  if (options_.linear_solver != "auto") return use(choice_.name, problem);
  choice_ = choose_step_solver(problem);
  use(choice_.name, problem);
  steps_->probe();
  const double condition = steps_->condition();
  std::ostringstream measured;
  measured << "the preconditioned matrix has a condition of about " << condition;
  if (condition > kMostCondition) {
    choice_ = {"cholmod", measured.str()};
    use(choice_.name, problem);
  } else if (condition > 0) {
    choice_.reason += ", and " + measured.str();
  }
  VLOG(1) << "linear_solver auto: " << choice_.name << ", since " << choice_.reason;
}

void GaussNewton::use(const std::string& linear_solver, const Problem& problem) {
  steps_ = make_step_solver(linear_solver, options_.threads);
  steps_->compile(problem);
  trial_ = problem.x;
  for (Eigen::VectorXd* x : {&delta_, &D_, &newton_, &gradient_, &last_newton_, &last_gradient_,
                             &last_delta_, &q_, &c_}) {
    x->setZero(steps_->linearization().unknowns());
  }
}

// From conjugate gradients that do not converge to a factorization, where `auto` chose them.
void GaussNewton::fall_back(const Problem& problem) {
  std::ostringstream why;
  why << "conjugate gradients did not converge (condition about " << steps_->condition() << ")";
  choice_ = {"cholmod", why.str()};
  summary_.notes.push_back("linear_solver auto: " + why.str() + "; JᵀJ is factored instead");
  VLOG(1) << summary_.notes.back();
  const LinearWork work = steps_->work;
  use("cholmod", problem);
  steps_->work = work;
  steps_->work.unfinished = 0;
  steps_->linearization().evaluate(problem.x);
  steps_->linearization().linearize(problem.x);
  conjugate_ = false;
}

// D of a damping by λ D.
void GaussNewton::measure_diagonal() {
  steps_->diagonal(D_);
  D_ = D_.cwiseMax(1e-6).cwiseMin(1e32);
}

bool GaussNewton::direction(const Problem& problem, double damping) {
  if (damping > 0) measure_diagonal();
  const bool regular = steps_->direction(damping, D_, delta_);
  const bool given_up = choice_.name == "kronecker_cg" && (!regular || steps_->work.unfinished > 0);
  if (options_.linear_solver != "auto" || !given_up) return regular;
  fall_back(problem);
  return direction(problem, damping);
}

// δ of Eq. 11. Where JᵀJ is singular (a motion that no term sees) the least damping that makes it
// regular picks the shortest of all solutions.
bool GaussNewton::newton_direction(const Problem& problem, double given) {
  bool regular = direction(problem, given);
  if (!regular) {
    steps_->diagonal(D_);
    const double largest = D_.maxCoeff();
    D_.setConstant(largest > 0 ? largest : 1);
    for (double damping = kRegularization; !regular && damping < 1; damping *= 100) {
      regular = steps_->direction(damping, D_, delta_);
    }
    if (summary_.notes.empty()) {
      summary_.notes.push_back("JᵀJ is singular: some motion changes no term; damped");
    }
  }
  return regular;
}

double GaussNewton::try_step(const Problem& problem, double scale) {
  Stopwatch watch(summary_.seconds["evaluate"]);
  tried_ = scale;
  steps_->linearization().step(problem.x, delta_, scale, trial_);
  return steps_->linearization().evaluate_step(trial_, scale);
}

GaussNewton::Outcome GaussNewton::full_step(Problem& problem, Iteration& iteration) {
  if (!newton_direction(problem)) return Outcome::kSingular;
  steps_->linearization().set_direction(delta_);
  iteration.cost = try_step(problem, 1);
  return std::isfinite(iteration.cost) ? Outcome::kAccepted : Outcome::kNotFinite;
}

GaussNewton::Outcome GaussNewton::line_search(Problem& problem, Iteration& iteration) {
  if (!newton_direction(problem)) return Outcome::kSingular;
  steps_->linearization().set_direction(delta_);
  const double slope = 2 * steps_->linearization().Jtr().dot(delta_);
  for (double scale = 1; scale >= kSmallestStep; scale /= 2) {
    iteration.cost = try_step(problem, scale);
    iteration.step_scale = scale;
    const double enough = cost_ + kSufficientDecrease * scale * slope + kRounding * (1 + cost_);
    if (iteration.cost <= enough) return Outcome::kAccepted;
  }
  return Outcome::kUphill;
}

// Gauss–Newton's direction, made conjugate to the last one (Polak and Ribière's formula, with JᵀJ
// as the preconditioner): where its steps alone close a gap at a constant rate, these do it faster.
void GaussNewton::conjugate() {
  newton_ = delta_;
  gradient_ = steps_->linearization().Jtr();
  const double slope = gradient_.dot(newton_);
  if (conjugate_) {
    const double before = last_gradient_.dot(last_newton_);
    const double beta = (slope - last_gradient_.dot(newton_)) / before;
    if (beta > 0 && beta < kMostConjugate) {
      delta_ += beta * last_delta_;
      if (gradient_.dot(delta_) > kDescent * slope) delta_ = newton_;  // slopes are negative
    }
  }
  last_newton_.swap(newton_);
  last_gradient_.swap(gradient_);
  conjugate_ = true;
}

// Finds a good length along δ: the least of a parabola through F, its slope and F at a first
// length, which F there then corrects.
void GaussNewton::find_length(const Problem& problem, double slope, Iteration& iteration) {
  double scale = 1;
  iteration.cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostLengths; ++i) {
    const double there = try_step(problem, scale);
    if (there < iteration.cost) iteration.cost = there, iteration.step_scale = scale;
    const double bend = there - cost_ - scale * slope;
    double next = scale / 2;
    if (std::isfinite(there)) {
      if (!(bend > kRounding * (1 + cost_))) break;
      next = std::clamp(-slope * scale * scale / (2 * bend), scale / 10, 4.0);
    }
    if (std::abs(next - scale) < kSameLength * scale) break;
    scale = next;
  }
}

// The full step, bent as the residuals bend away from their linearization; where F then is less
// than along δ, it is taken.
bool GaussNewton::bend(const Problem& problem, Iteration& iteration) {
  if (!std::isfinite(try_step(problem, 1))) return false;
  steps_->linearization().bend(problem.x, delta_, q_);
  if (!steps_->correction(q_, c_)) return false;
  delta_ += c_;
  steps_->linearization().set_direction(delta_);
  const double there = try_step(problem, 1);
  bends_ = there < iteration.cost;
  if (bends_) {
    iteration.cost = there;
    iteration.step_scale = 1;
    return true;
  }
  delta_ -= c_;
  steps_->linearization().set_direction(delta_);
  tried_ = 0;
  return false;
}

// Directions of which little could be taken are damped next time.
void GaussNewton::adapt_damping(double length) {
  if (length < kShort) damping_ = std::max(kShortDamping, 4 * damping_);
  if (length > kLong) damping_ = damping_ > kShortDamping / 8 ? damping_ / 4 : 0;
}

GaussNewton::Outcome GaussNewton::accelerated(Problem& problem, Iteration& iteration) {
  iteration.damping = damping_;
  if (!newton_direction(problem, damping_)) return Outcome::kSingular;
  conjugate();
  steps_->linearization().set_direction(delta_);
  const double slope = 2 * steps_->linearization().Jtr().dot(delta_);
  find_length(problem, slope, iteration);
  const double promised = -slope / 2;
  const bool poor = !(cost_ - iteration.cost > kPoor * promised);
  adapt_damping(iteration.step_scale);
  if (bends_ && poor && promised > kRounding * (1 + cost_) && bend(problem, iteration)) {
    conjugate_ = false;
    return Outcome::kAccepted;
  }
  last_delta_ = delta_;
  while (iteration.cost >
         cost_ + kSufficientDecrease * iteration.step_scale * slope + kRounding * (1 + cost_)) {
    iteration.step_scale /= 2;
    if (iteration.step_scale < kSmallestStep) return Outcome::kUphill;
    iteration.cost = try_step(problem, iteration.step_scale);
  }
  if (tried_ != iteration.step_scale) try_step(problem, iteration.step_scale);
  return Outcome::kAccepted;
}

// Nielsen's rule: λ follows the ratio of what F fell to what the linear model promised.
GaussNewton::Outcome GaussNewton::levenberg(Problem& problem, Iteration& iteration) {
  while (damping_ < kMostDamping) {
    iteration.damping = damping_;
    double promised = 0;
    iteration.cost = std::numeric_limits<double>::infinity();
    if (direction(problem, damping_)) {
      steps_->linearization().set_direction(delta_);
      iteration.cost = try_step(problem, 1);
      promised = damping_ * delta_.dot(D_.cwiseProduct(delta_)) -
                 delta_.dot(steps_->linearization().Jtr());
    }
    const double fell = cost_ - iteration.cost;
    if (fell >= -kRounding * (1 + cost_)) {
      const double ratio = promised > 0 ? std::max(0.0, fell / promised) : 1;
      damping_ =
          std::max(kLeastDamping, damping_ * std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3)));
      damping_growth_ = 2;
      return Outcome::kAccepted;
    }
    damping_ *= damping_growth_;
    damping_growth_ *= 2;
  }
  return Outcome::kUphill;
}

GaussNewton::Outcome GaussNewton::advance(Problem& problem, Iteration& iteration) {
  if (options_.globalization == "none") return full_step(problem, iteration);
  if (options_.globalization == "accelerated") return accelerated(problem, iteration);
  if (options_.globalization == "line_search") return line_search(problem, iteration);
  return levenberg(problem, iteration);
}

void GaussNewton::start(Problem& problem) {
  summary_ = {};
  steps_->work = {};
  for (const char* phase : {"evaluate", "linearize"}) {
    summary_.seconds[phase] = 0;  // exists before it is timed: no allocation in an iteration
  }
  summary_.iterations.reserve(std::min(options_.max_iterations, 1000));
  damping_ = options_.globalization == "accelerated" ? 0 : kFirstDamping;
  damping_growth_ = 2;
  conjugate_ = false;
  bends_ = true;
  trial_.X = problem.x.X;  // brings the fixed nodes along
  steps_->linearization().set_targets();
  cost_ = summary_.initial_cost = steps_->linearization().evaluate(problem.x);
  if (std::isfinite(cost_)) steps_->linearization().linearize(problem.x);
}

Summary GaussNewton::finish(const Problem& problem, Status status, std::string message) {
  summary_.status = status;
  summary_.message = std::move(message);
  const std::vector<double> costs = steps_->linearization().cost_by_term(problem.x);
  summary_.final_cost = std::accumulate(costs.begin(), costs.end(), 0.0);
  if (!summary_.iterations.empty()) summary_.iterations.back().cost = summary_.final_cost;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    summary_.cost_by_term[std::string(problem.terms[i].energy->name())] = costs[i];
  }
  summary_.unknowns = steps_->linearization().unknowns();
  if (summary_.unknowns > 0) {
    summary_.nonzeros_JtJ = steps_->nonzeros_JtJ();
    summary_.nonzeros_factor = steps_->nonzeros_factor();
    summary_.condition = steps_->condition();
  }
  summary_.factorizations = steps_->work.factorizations;
  summary_.cg_iterations = steps_->work.cg_iterations;
  summary_.seconds["factorize"] = steps_->work.factorize_seconds;
  summary_.seconds["solve"] = steps_->work.solve_seconds;
  summary_.method = "gauss_newton";
  summary_.linear_solver = choice_.name;
  summary_.choice = choice_.reason;
  summary_.globalization = options_.globalization;
  summary_.blas = blas_name();
  summary_.threads = choice_.name == "eigen_ldlt" ? 1 : options_.threads;
  return summary_;
}

std::pair<Status, std::string> GaussNewton::iterate(Problem& problem) {
  if (!std::isfinite(cost_)) return {Status::kFailed, "F is not finite at the start"};
  if (steps_->linearization().unknowns() == 0) return {Status::kConverged, "every node is fixed"};
  for (int i = 0; i < options_.max_iterations; ++i) {
    Iteration iteration;
    Stopwatch watch(iteration.seconds);
    switch (advance(problem, iteration)) {
      case Outcome::kAccepted:
        break;
      case Outcome::kUphill:
        return {Status::kStalled, "no step along the search direction lowers F"};
      case Outcome::kNotFinite:
        return {Status::kFailed, "a step makes F infinite: try another solver.globalization"};
      case Outcome::kSingular:
        return {Status::kFailed, "JᵀJ cannot be factorized, however damped"};
    }
    std::swap(problem.x.X, trial_.X);
    {
      Stopwatch linearize_watch(summary_.seconds["linearize"]);
      iteration.cost = steps_->linearization().linearize_step(problem.x);
    }
    iteration.gradient_max = 2 * steps_->linearization().Jtr().lpNorm<Eigen::Infinity>();
    iteration.step_max = iteration.step_scale * delta_.lpNorm<Eigen::Infinity>();
    iteration.seconds = watch.elapsed();
    summary_.iterations.push_back(iteration);
    const double previous = std::exchange(cost_, iteration.cost);
    if (converged(cost_, previous, iteration.gradient_max, iteration.step_max, options_.epsilon)) {
      return {Status::kConverged, "the three conditions of Eq. 12 hold"};
    }
  }
  return {Status::kMaxIterations, "Eq. 12 does not hold after solver.max_iterations steps"};
}

Summary GaussNewton::solve(Problem& problem) {
  double total = 0;
  std::pair<Status, std::string> outcome;
  {
    Stopwatch watch(total);
    start(problem);
    outcome = iterate(problem);
  }
  summary_.seconds["total"] = total;
  return finish(problem, outcome.first, std::move(outcome.second));
}

}  // namespace deformlab
