#pragma once

#include "deformers/baselines/prism_equations.h"
#include "solvers/summary.h"

namespace deformlab {

/// Minimises E from the given motions and sets them to the result. Steps are Newton steps, or leave
/// out the concave part where the second derivative is not positive definite. Each is halved until
/// E falls. The iteration ends when the three conditions of Sumner et al. 2007, Eq. 12, hold.
Summary minimize(PrismEquations& equations, RigidMotions& motions, double epsilon,
                 int max_iterations);

}  // namespace deformlab
