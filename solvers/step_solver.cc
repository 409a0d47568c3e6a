#include "solvers/step_solver.h"

#include "solvers/direct_steps.h"
#include "solvers/separable_cg.h"

namespace deformlab {
namespace {

constexpr int kFewUnknowns = 100;  // whose JᵀJ is factored in no time

}  // namespace

Choice choose_step_solver(const Stage& stage) {
  const auto unknowns = stage.x.X.size();
  if (unknowns < kFewUnknowns) {
    return {"cholmod", "there are only " + std::to_string(unknowns) + " unknowns"};
  }
  bool separable = false;
  for (const WeightedEnergy& term : stage.terms) {
    separable |= term.structure() == Structure::kSeparable && term.energy->size() > 0;
    if (term.structure() != Structure::kLinear) continue;
    return {"cholmod", "the term '" + std::string(term.energy->name()) + "' mixes the coordinates"};
  }
  if (!separable) return {"cholmod", "no term is separable"};
  return {"separable_cg", std::to_string(unknowns) + " unknowns are coupled by separable terms"};
}

std::unique_ptr<StepSolver> make_step_solver(const std::string& name, int threads) {
  if (name == "separable_cg") return std::make_unique<SeparableCg>(threads);
  return std::make_unique<DirectSteps>(make_linear_solver(name, threads));
}

}  // namespace deformlab
