#include "solvers/gauss_newton/gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solvers/compiled.h"
#include "solvers/linear/blas.h"
#include "solvers/stopwatch.h"

namespace deformlab {

GaussNewton::GaussNewton(const SolverOptions& options)
    : options_(options),
      steps_(make_step_solver(options.linear_solver, options.threads)),
      globalization_(make_globalization(options.globalization)) {}

void GaussNewton::compile(const Problem& problem) {
  check(problem);
  iterate_.reset();
  linearization_.reset();
  linearization_.emplace(problem, steps_->prepare(problem));
  steps_->compile(*linearization_);
  iterate_.emplace(problem, *linearization_, *steps_);
}

bool GaussNewton::change_elements(const Problem& problem, std::size_t term) {
  check_term(problem, term);
  if (!iterate_) return false;
  if (linearization_->change_elements(problem, term) && steps_->change_elements(*linearization_)) {
    return true;
  }
  iterate_.reset();  // what was compiled refers to the energy that was replaced
  linearization_.reset();
  return false;
}

void GaussNewton::start(Problem& problem) {
  summary_ = {};
  for (const char* phase : {"evaluate", "linearize", "factorize", "solve"}) {
    summary_.seconds[phase] = 0;  // makes the entry now, so that no iteration allocates it
  }
  summary_.iterations.reserve(std::min(options_.max_iterations, 1000));
  globalization_->start(linearization_->unknowns());
  iterate_->start(problem, summary_);
  summary_.initial_cost = iterate_->cost();
}

std::pair<Status, std::string> GaussNewton::run() {
  if (!iterate_->finite()) {
    return {Status::kFailed, "F or its derivative is not finite at the start"};
  }
  if (linearization_->unknowns() == 0) return {Status::kConverged, "every node is fixed"};
  for (int i = 0; i < options_.max_iterations; ++i) {
    Iteration step;
    Stopwatch watch(step.seconds);
    switch (globalization_->advance(*iterate_, step)) {
      case Outcome::kAccepted:
        break;
      case Outcome::kUphill:
        return {Status::kStalled, "no step along the search direction lowers F"};
      case Outcome::kNotFinite:
        return {Status::kFailed, "F is not finite after a step: try another solver.globalization"};
      case Outcome::kSingular:
        return {Status::kFailed, "JᵀJ cannot be factorized, however damped"};
    }
    const double previous = iterate_->cost();
    if (!iterate_->accept()) {
      return {Status::kFailed, "F or its derivative is not finite after a step"};
    }
    step.cost = iterate_->cost();
    step.gradient_max = 2 * iterate_->gradient().lpNorm<Eigen::Infinity>();
    step.step_max = step.step_scale * iterate_->delta().lpNorm<Eigen::Infinity>();
    step.seconds = watch.elapsed();
    summary_.iterations.push_back(step);
    if (converged(step.cost, previous, step.gradient_max, step.step_max, options_.epsilon)) {
      return {Status::kConverged, "the three conditions of Eq. 12 hold"};
    }
  }
  return {Status::kMaxIterations, "Eq. 12 does not hold after solver.max_iterations steps"};
}

// Says which term made a solve end, if F or its derivative was not finite where it ended.
std::string GaussNewton::culprit(const Problem& problem, Status status) const {
  if (status != Status::kFailed && status != Status::kStalled) return "";
  const Energy* term = not_finite_term(problem, problem.x);
  if (term == nullptr) term = not_finite_term(problem, iterate_->trial());
  return term == nullptr ? "" : not_finite_message(*term);
}

Summary GaussNewton::finish(const Problem& problem, Status status, std::string message) {
  summary_.status = status;
  summary_.message = std::move(message);
  const std::vector<double> costs = linearization_->cost_by_term(problem.x);
  summary_.final_cost = std::accumulate(costs.begin(), costs.end(), 0.0);
  if (!summary_.iterations.empty()) summary_.iterations.back().cost = summary_.final_cost;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    summary_.cost_by_term[std::string(problem.terms[i].energy->name())] = costs[i];
  }
  summary_.unknowns = linearization_->unknowns();
  if (summary_.unknowns > 0) {
    summary_.nonzeros_JtJ = steps_->nonzeros_JtJ(*linearization_);
    summary_.nonzeros_factor = steps_->nonzeros_factor();
    summary_.condition = steps_->condition();
  }
  summary_.method = "gauss_newton";
  summary_.linear_solver = steps_->name();
  summary_.choice = steps_->reason();
  summary_.globalization = options_.globalization;
  summary_.blas = blas_name();
  summary_.threads = steps_->threads();
  return summary_;
}

Summary GaussNewton::solve(Problem& problem) {
  check_compiled(problem, iterate_ ? &linearization_->columns().first() : nullptr,
                 iterate_ ? linearization_->terms() : 0);
  double total = 0;
  std::pair<Status, std::string> outcome;
  {
    Stopwatch watch(total);
    start(problem);
    outcome = run();
  }
  summary_.seconds["total"] = total;
  outcome.second += culprit(problem, outcome.first);
  return finish(problem, outcome.first, std::move(outcome.second));
}

}  // namespace deformlab
