#include "solvers/gauss_newton/step_solver.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/core/error.h"
#include "solvers/gauss_newton/direct_steps.h"
#include "solvers/gauss_newton/kronecker_cg.h"

namespace deformlab {
namespace {

constexpr int kFewUnknowns = 100;  // whose JᵀJ is factored in no time

}  // namespace

Choice choose_step_solver(const Problem& problem) {
  const auto unknowns = problem.x.X.size();
  if (unknowns < kFewUnknowns) {
    return {"cholmod", "there are only " + std::to_string(unknowns) + " unknowns"};
  }
  bool Kronecker = false;
  for (const WeightedEnergy& term : problem.terms) {
    Kronecker |= term.structure() == Structure::kKronecker && term.energy->size() > 0;
    if (term.structure() != Structure::kLinear) continue;
    return {"cholmod", "the term '" + std::string(term.energy->name()) + "' mixes the coordinates"};
  }
  if (!Kronecker) return {"cholmod", "no term is Kronecker"};
  return {"kronecker_cg", std::to_string(unknowns) + " unknowns are coupled by Kronecker terms"};
}

std::unique_ptr<StepSolver> make_step_solver(const std::string& name, int threads) {
  if (name == "kronecker_cg") return std::make_unique<KroneckerCg>();
  std::vector<std::string> known = linear_solver_names();
  if (std::ranges::find(known, name) == known.end()) {
    known.insert(known.end(), {"auto", "kronecker_cg"});
    throw InputError(
        fmt::format("solver.linear_solver '{}' is not one of gauss_newton's; known: {}", name,
                    fmt::join(known, ", ")));
  }
  return std::make_unique<DirectSteps>(make_linear_solver(name, threads));
}

}  // namespace deformlab
