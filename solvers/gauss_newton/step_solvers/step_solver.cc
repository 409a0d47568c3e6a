#include "solvers/gauss_newton/step_solvers/step_solver.h"

#include <fmt/format.h>

#include <utility>

#include "solvers/gauss_newton/step_solvers/auto_steps.h"
#include "solvers/gauss_newton/step_solvers/direct_steps.h"
#include "solvers/gauss_newton/step_solvers/kronecker_cg.h"
#include "solvers/registry.h"

namespace deformlab {
namespace {

auto& registry() {
  static Registry<StepSolver, int> solvers(
      "step solver", {
                         {"auto", [](int threads) { return std::make_unique<AutoSteps>(threads); }},
                         {"kronecker_cg", [](int) { return std::make_unique<KroneckerCg>(); }},
                     });
  return solvers;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

ColumnOrder StepSolver::prepare(const Problem&) { return ColumnOrder::kAsGiven; }

void StepSolver::update(const Linearization&) {}

void StepSolver::diagonal(const Linearization& linearization, Eigen::VectorXd& D) const {
  const SparseMatrix& A = linearization.A();
  const int d = linearization.columns().dimension();
  for (int c = 0; c < A.cols(); ++c) {
    D.segment(d * c, d).setConstant(A.valuePtr()[A.outerIndexPtr()[c]]);  // first in its column
  }
  for (const ElementDerivatives* part : linearization.derivatives()) part->add_diagonal(D);
}

void register_step_solver(const std::string& name, StepSolverFactory factory) {
  if (has(linear_solver_names(), name)) {
    throw InputError(
        fmt::format("there is a linear solver '{}' already; choose another name", name));
  }
  registry().add(name, std::move(factory));
}

std::unique_ptr<StepSolver> make_step_solver(const std::string& name, int threads) {
  if (registry().has(name)) return registry().make(name, threads);
  if (has(linear_solver_names(), name)) {
    return std::make_unique<DirectSteps>(name, make_linear_solver(name, threads));
  }
  throw InputError(fmt::format("solver.linear_solver '{}' is not one of gauss_newton's; known: {}",
                               name, fmt::join(step_solver_names(), ", ")));
}

std::vector<std::string> step_solver_names() {
  std::vector<std::string> names = registry().names();
  const std::vector<std::string> linear = linear_solver_names();
  names.insert(names.begin() + 1, linear.begin(), linear.end());  // after auto
  return names;
}

}  // namespace deformlab
