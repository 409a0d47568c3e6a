#include "solvers/gauss_newton/step_solvers/auto_steps.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <utility>

#include "solvers/linear/linear_solver.h"

namespace deformlab {
namespace {

constexpr int kFewUnknowns = 100;       // with fewer, factoring JᵀJ takes almost no time
constexpr double kMostCondition = 1e5;  // beyond it, conjugate gradients are not tried

// Why the number of unknowns or the structure of the terms requires factoring JᵀJ; else empty.
std::string reason_to_factor(const Problem& problem) {
  const auto unknowns = problem.x.X.size();
  if (unknowns < kFewUnknowns) return fmt::format("there are only {} unknowns", unknowns);
  bool has_kronecker = false;
  for (const WeightedEnergy& term : problem.terms) {
    has_kronecker |= term.structure() == Structure::kKronecker && term.energy->size() > 0;
    if (term.structure() != Structure::kLinear) continue;
    return fmt::format("the term '{}' mixes the coordinates", term.energy->name());
  }
  return has_kronecker ? "" : "no term is Kronecker";
}

}  // namespace

StepSolver& AutoSteps::chosen() const {
  if (iterative_) return *iterative_;
  return *direct_;
}

void AutoSteps::use_conjugate_gradients(std::string reason) {
  direct_.reset();
  iterative_ = std::make_unique<KroneckerCg>();
  reason_ = std::move(reason);
}

void AutoSteps::use_factorization(std::string reason) {
  iterative_.reset();
  direct_ = std::make_unique<DirectSteps>("cholmod", make_cholmod(threads_));
  reason_ = std::move(reason);
}

ColumnOrder AutoSteps::prepare(const Problem& problem) {
  unfinished_ = false;
  const std::string factor = reason_to_factor(problem);
  if (!factor.empty()) {
    use_factorization(factor);
  } else {
    use_conjugate_gradients(
        fmt::format("{} unknowns are coupled by Kronecker terms", problem.x.X.size()));
  }
  return chosen().prepare(problem);
}

void AutoSteps::compile(const Linearization& linearization) {
  chosen().compile(linearization);
  if (iterative_) {
    const double condition = iterative_->estimate_condition(linearization);
    const std::string measured =
        fmt::format("the preconditioned matrix has a condition of about {:g}", condition);
    if (condition > kMostCondition) {
      use_factorization(measured);
      direct_->compile(linearization);
    } else if (condition > 0) {
      reason_ += ", and " + measured;
    }
  }
  VLOG(1) << "linear_solver auto: " << name() << ", since " << reason_;
}

StepResult AutoSteps::direction(const Linearization& linearization, double damping,
                                const Eigen::VectorXd& D, Eigen::VectorXd& delta) {
  StepResult tried = chosen().direction(linearization, damping, D, delta);
  unfinished_ |= !tried.finished;
  if (direct_ || (tried.regular && !unfinished_)) return tried;
  use_factorization(
      fmt::format("conjugate gradients did not converge (condition about {:g})", condition()));
  direct_->compile(linearization);
  direct_->update(linearization);
  StepResult result = direct_->direction(linearization, damping, D, delta);
  result.cg_iterations = tried.cg_iterations;
  result.solve_seconds += tried.solve_seconds;
  result.note = fmt::format("linear_solver auto: {}; JᵀJ is factored instead", reason_);
  VLOG(1) << result.note;
  return result;
}

StepResult AutoSteps::geodesic_correction(const Linearization& linearization,
                                          const Eigen::VectorXd& q, Eigen::VectorXd& c) {
  StepResult result = chosen().geodesic_correction(linearization, q, c);
  unfinished_ |= !result.finished;
  return result;
}

}  // namespace deformlab
