#include "solvers/solver.h"

#include <cmath>

#include "geometry/core/error.h"
#include "solvers/ceres/ceres_solver.h"
#include "solvers/gauss_newton/gauss_newton.h"

namespace deformlab {
namespace {

constexpr int kMostThreads = 1024;

void check(const SolverOptions& o) {
  if (!(o.epsilon > 0 && o.epsilon < 1)) {
    throw InputError("solver.epsilon is " + std::to_string(o.epsilon) +
                     "; it lies between 0 and 1 (the paper uses 1e-6)");
  }
  if (o.max_iterations < 1) {
    throw InputError("solver.max_iterations is " + std::to_string(o.max_iterations) +
                     "; at least 1 is needed");
  }
  if (o.threads < 1 || o.threads > kMostThreads) {
    throw InputError("solver.threads is " + std::to_string(o.threads) + "; it lies between 1 and " +
                     std::to_string(kMostThreads));
  }
  if (o.globalization != "none" && o.globalization != "accelerated" &&
      o.globalization != "line_search" && o.globalization != "levenberg") {
    throw InputError("unknown solver.globalization '" + o.globalization +
                     "'; known: none, line_search, levenberg, accelerated");
  }
}

}  // namespace

const char* to_string(Status status) {
  switch (status) {
    case Status::kConverged:
      return "converged";
    case Status::kMaxIterations:
      return "max_iterations";
    case Status::kStalled:
      return "stalled";
    case Status::kFailed:
      break;
  }
  return "failed";
}

bool converged(double cost, double previous_cost, double gradient_max, double step_max,
               double epsilon) {
  const double root = std::cbrt(epsilon);
  return std::abs(cost - previous_cost) < epsilon * (1 + cost) &&
         gradient_max < root * (1 + cost) && step_max < root * (1 + step_max);
}

std::unique_ptr<Solver> make_solver(const SolverOptions& options) {
  check(options);
  if (options.method == "gauss_newton") return std::make_unique<GaussNewton>(options);
  if (options.method == "ceres") return std::make_unique<CeresSolver>(options);
  throw InputError("unknown solver.method '" + options.method + "'; known: gauss_newton, ceres");
}

}  // namespace deformlab
