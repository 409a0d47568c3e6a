#include "solvers/step_solver.h"

#include "solvers/direct_steps.h"
#include "solvers/separable_cg.h"

namespace deformlab {

std::unique_ptr<StepSolver> make_step_solver(const std::string& name) {
  if (name == "separable_cg") return std::make_unique<SeparableCg>();
  return std::make_unique<DirectSteps>(make_linear_solver(name));
}

}  // namespace deformlab
