#pragma once

#include <cstddef>
#include <memory>

#include "solvers/options.h"
#include "solvers/problem.h"
#include "solvers/summary.h"

namespace deformlab {

/// Minimises problems. `compile` does what depends only on the structure, which is given by the
/// free nodes and the elements. It is called once for a set of handles. After it, `solve` may be
/// called any number of times, with other targets and another state each time.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Throws InputError for a problem that `check` refuses, or that the solver does not support.
  virtual void compile(const Problem& problem) = 0;
  /// Adapts to a term whose energy was replaced, because its elements are others, such as handles
  /// that were added or removed. All else has to be as it was compiled. Returns false if the
  /// problem has to be compiled again: this solver cannot adapt, or too much has changed since the
  /// last compilation. `solve` then refuses the problem until it is compiled. Throws InputError for
  /// a term that `check` refuses.
  virtual bool change_elements(const Problem& /*problem*/, std::size_t /*term*/) { return false; }
  /// Throws InputError unless the compiled problem has the same nodes and number of terms.
  virtual Summary solve(Problem& problem) = 0;
};

/// The solver that options.method names. Throws OptionError for a value that the description of its
/// field does not allow, and for a linear solver that the method does not have.
std::unique_ptr<Solver> make_solver(const SolverOptions& options);

/// Whether the change of F, its gradient and the step are all small (Sumner et al. 2007, Eq. 12).
bool converged(double cost, double previous_cost, double gradient_max, double step_max,
               double epsilon);

}  // namespace deformlab
