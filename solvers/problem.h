#pragma once

#include <memory>
#include <vector>

#include "energies/energy.h"
#include "solvers/loss.h"

namespace deformlab {

/// One weighted term of the objective.
struct WeightedEnergy {
  std::unique_ptr<Energy> energy;
  double weight = 1;                                          ///< w ≥ 0
  std::shared_ptr<const ceres::LossFunction> loss = nullptr;  ///< ρ; null: ρ(s) = s

  /// The structure that a solver may rely on. A loss makes any term nonlinear.
  Structure structure() const { return loss ? Structure::kNonlinear : energy->structure(); }
};

/// One problem: minimise F(X) = Σ w E(X) over the nodes that are free (Sumner et al. 2007, Eq. 9);
/// a term with a loss counts by w Σ_e ρ(‖r_e‖²).
struct Problem {
  Unknowns x;               ///< the last state; a solve starts here and leaves its result here
  std::vector<char> fixed;  ///< per node: eliminated from the unknowns, never penalised
  std::vector<WeightedEnergy> terms;
};

/// Throws InputError for a term that reads nodes which the problem does not have, or of another
/// dimension or fewer columns than it takes, or that does not have the structure it declares.
void check(const Problem& problem);

/// The cost of each term at x, in the order of the problem.
std::vector<double> cost_by_term(const Problem& problem, const Unknowns& x);

/// F at x, which is the sum of these costs.
double cost(const Problem& problem, const Unknowns& x);

}  // namespace deformlab
