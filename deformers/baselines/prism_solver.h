#pragma once

#include "deformers/baselines/prism_equations.h"
#include "solvers/summary.h"

namespace deformlab {

/// Minimises E by Gauss–Newton steps from the given motions, which are left at the result; each
/// step is halved until E falls. Ends by the three conditions of Sumner et al. 2007, Eq. 12.
Summary minimize(PrismEquations& equations, RigidMotions& motions, double epsilon,
                 int max_iterations);

}  // namespace deformlab
