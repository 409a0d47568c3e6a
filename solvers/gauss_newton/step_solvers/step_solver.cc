#include "solvers/gauss_newton/step_solvers/step_solver.h"

#include <fmt/format.h>

#include <utility>

#include "solvers/gauss_newton/step_solvers/auto_steps.h"
#include "solvers/gauss_newton/step_solvers/direct_steps.h"
#include "solvers/gauss_newton/step_solvers/kronecker_cg.h"
#include "solvers/linear/eigen_ldlt.h"
#include "solvers/registry.h"

namespace deformlab {
namespace {

/// Makes step solvers that factor JᵀJ with what `make` returns.
StepSolverFactory direct_steps(const std::string& name, const LinearSolverFactory& make) {
  if (!make) return nullptr;
  return [=](int threads) { return std::make_unique<DirectSteps>(name, make(threads)); };
}

auto& registry() {
  const auto eigen_ldlt = [](int) { return std::make_unique<EigenLdlt>(); };
  static Registry<StepSolver, int> solvers(
      "linear solver", {{"auto", [](int threads) { return std::make_unique<AutoSteps>(threads); }},
                        {"cholmod", direct_steps("cholmod", make_cholmod)},
                        {"eigen_ldlt", direct_steps("eigen_ldlt", eigen_ldlt)},
                        {"kronecker_cg", [](int) { return std::make_unique<KroneckerCg>(); }}});
  return solvers;
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
  for (const LowRankChange::Vector& v : linearization.change_of_A().vectors()) {
    for (const auto& [rank, a] : v.u) D.segment(d * rank, d).array() += v.s * a * a;
  }
  for (const ElementDerivatives* part : linearization.derivatives()) part->add_diagonal(D);
}

void register_step_solver(const std::string& name, StepSolverFactory factory) {
  registry().add(name, std::move(factory));
}

void register_linear_solver(const std::string& name, const LinearSolverFactory& factory) {
  registry().add(name, direct_steps(name, factory));
}

std::unique_ptr<StepSolver> make_step_solver(const std::string& name, int threads) {
  if (registry().has(name)) return registry().make(name, threads);
  throw InputError(fmt::format("solver.linear_solver '{}' is not one of gauss_newton's; known: {}",
                               name, fmt::join(step_solver_names(), ", ")));
}

std::vector<std::string> step_solver_names() { return registry().names(); }

}  // namespace deformlab
