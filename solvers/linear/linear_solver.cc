#include "solvers/linear/linear_solver.h"

#include <utility>

#include "solvers/linear/cholmod_solver.h"
#include "solvers/linear/eigen_ldlt.h"
#include "solvers/registry.h"

namespace deformlab {
namespace {

auto& registry() {
  static Registry<LinearSolver, int> solvers(
      "linear solver",
      {
          {"cholmod", [](int threads) { return std::make_unique<CholmodSolver>(threads); }},
          {"eigen_ldlt", [](int) { return std::make_unique<EigenLdlt>(); }},
      });
  return solvers;
}

}  // namespace

Eigen::VectorXi LinearSolver::order(const SparseMatrix& lower, int, bool) {
  return Eigen::VectorXi::LinSpaced(lower.cols(), 0, static_cast<int>(lower.cols()) - 1);
}

void register_linear_solver(const std::string& name, LinearSolverFactory factory) {
  registry().add(name, std::move(factory));
}

std::unique_ptr<LinearSolver> make_linear_solver(const std::string& name, int threads) {
  return registry().make(name, threads);
}

std::vector<std::string> linear_solver_names() { return registry().names(); }

}  // namespace deformlab
