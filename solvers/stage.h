#pragma once

#include <memory>
#include <vector>

#include "energies/energy.h"

namespace deformlab {

/// One weighted term of the objective.
struct WeightedEnergy {
  std::unique_ptr<Energy> energy;
  double weight = 1;  ///< w ≥ 0
};

/// One problem: minimise F(X) = Σ w E(X) over the nodes that are free (Sumner et al. 2007, Eq. 9).
struct Stage {
  Unknowns x;               ///< the last state; a solve starts here and leaves its result here
  std::vector<char> fixed;  ///< per node: eliminated from the unknowns, never penalised
  std::vector<WeightedEnergy> terms;
};

/// Throws InputError for a term that reads nodes which the stage does not have, or of another
/// dimension or fewer columns than it takes.
void check(const Stage& stage);

/// F at x.
double cost(const Stage& stage, const Unknowns& x);

}  // namespace deformlab
