#pragma once

#include <memory>

#include "solvers/options.h"
#include "solvers/problem.h"
#include "solvers/summary.h"

namespace deformlab {

/// Minimises problems. `compile` does what depends on the structure alone (which nodes are free,
/// which elements there are) and is paid once for a set of handles; `solve` may be called any
/// number of times after it, with targets and state changed in between.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual void compile(const Problem& problem) = 0;
  virtual Summary solve(Problem& problem) = 0;
};

/// The solver that options.method names. Throws OptionError for a value that the description of its
/// field does not allow, and for a linear solver that the method does not have.
std::unique_ptr<Solver> make_solver(const SolverOptions& options);

/// Eq. 12: the change of F, its gradient and the step are all small.
bool converged(double cost, double previous_cost, double gradient_max, double step_max,
               double epsilon);

}  // namespace deformlab
