#pragma once

#include "energies/constraint.h"
#include "energies/regularization.h"
#include "energies/rotation.h"

namespace deformlab {

template <class... Term>
struct TermList {};

/// Every energy term there is. A term that is named here has a weight in configs, both solvers, a
/// column in results and every law test.
using AllTerms = TermList<Rotation, Regularization, Constraint>;

}  // namespace deformlab
