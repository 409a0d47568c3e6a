#pragma once

#include <memory>
#include <string>
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

/// The problem of minimising F(X) = Σ w E(X) over the free nodes (Sumner et al. 2007, Eq. 9). A
/// term with a loss contributes w Σ_e ρ(‖r_e‖²) instead of w E(X).
struct Problem {
  Unknowns x;               ///< the state: a solve starts from it and writes its result to it
  std::vector<char> fixed;  ///< whether each node is fixed; the solver does not change such nodes
  std::vector<WeightedEnergy> terms;
};

/// Throws InputError if the sizes of x and fixed differ, and for a term that has no energy or a
/// negative weight, that reads nodes or columns which the problem does not have, that has another
/// dimension than the problem, or that does not have the structure it declares.
void check(const Problem& problem);

/// Checks only this term in this way.
void check_term(const Problem& problem, std::size_t term);

/// The first term whose residuals or derivatives at x are not all finite; null if all are.
const Energy* not_finite_term(const Problem& problem, const Unknowns& x);
/// The end of a message that says so.
std::string not_finite_message(const Energy& term);

/// The cost of each term at x, in the order of the problem.
std::vector<double> cost_by_term(const Problem& problem, const Unknowns& x);

/// F at x, which is the sum of these costs.
double cost(const Problem& problem, const Unknowns& x);

}  // namespace deformlab
