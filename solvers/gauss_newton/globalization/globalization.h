#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solvers/gauss_newton/iterate.h"

namespace deformlab {

/// How the search for a step ended.
enum class Outcome {
  kAccepted,   ///< the last trial point of the iterate becomes the new x
  kUphill,     ///< no step that was tried lowers F
  kNotFinite,  ///< F is not finite after the step
  kSingular    ///< JᵀJ cannot be factored, even with damping
};

/// Makes Gauss–Newton converge from a distant start: it chooses the direction and the length of
/// each step.
class Globalization {
 public:
  virtual ~Globalization() = default;

  /// Called at the start of each solve. Memory for n unknowns should be allocated here, because
  /// `advance` should allocate nothing.
  virtual void start(int /*unknowns*/) {}
  /// Finds a step from the iterate and leaves its end as the trial point. Fills step.cost,
  /// step.step_scale (if it is not 1) and step.damping.
  virtual Outcome advance(Iterate& iterate, Iteration& step) = 0;
};

using GlobalizationFactory = std::function<std::unique_ptr<Globalization>()>;

/// Makes `name` a value of solver.globalization. Throws InputError if the name is taken.
void register_globalization(const std::string& name, GlobalizationFactory factory);

/// Makes "none", "line_search", "levenberg", "accelerated" or a registered one. Throws InputError
/// for any other name; the message lists the known ones.
std::unique_ptr<Globalization> make_globalization(const std::string& name);

/// The names that make_globalization knows.
std::vector<std::string> globalization_names();

}  // namespace deformlab
