#include "solvers/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solvers/ceres/ceres_solver.h"
#include "solvers/gauss_newton/gauss_newton.h"

namespace deformlab {
namespace {

// Throws OptionError unless the method has the linear solver.
void check_linear_solver(const SolverOptions& options) {
  const std::vector<std::string> names = linear_solver_choices(options.method);
  const std::string& name = options.linear_solver;
  if (name == "auto" || std::find(names.begin(), names.end(), name) != names.end()) return;
  throw OptionError("linear_solver", fmt::format("'{}'", name),
                    fmt::format(", which is not one of {}'s; known: auto, {}",
                                name_of(options.method), fmt::join(names, ", ")));
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
  check_options(options);
  check_linear_solver(options);
  if (options.method == SolverMethod::kCeres) return std::make_unique<CeresSolver>(options);
  return std::make_unique<GaussNewton>(options);
}

}  // namespace deformlab
