#include "solvers/problem.h"

#include <numeric>
#include <string>

#include "energies/structure.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

bool fits(const Energy& energy, const Unknowns& x) {
  if (energy.dimension() != x.dimension()) return false;
  const std::span<const int> nodes = energy.nodes();
  const int arity = energy.arity();
  for (int a = 0; a < arity; ++a) {
    const int count = energy.argument(a).count;
    for (std::size_t i = a; i < nodes.size(); i += arity) {
      if (nodes[i] < 0 || nodes[i] >= x.nodes() || count > x.columns(nodes[i])) return false;
    }
  }
  return true;
}

}  // namespace

void check(const Problem& problem) {
  for (const WeightedEnergy& term : problem.terms) {
    if (!fits(*term.energy, problem.x)) {
      throw InputError("the term '" + std::string(term.energy->name()) +
                       "' reads nodes that this problem does not have: check the node indices, the "
                       "dimension and the columns of its arguments");
    }
    check_structure(*term.energy);
  }
}

std::vector<double> cost_by_term(const Problem& problem, const Unknowns& x) {
  std::vector<double> costs;
  for (const WeightedEnergy& term : problem.terms) {
    Eigen::MatrixXd r(term.energy->rows(), term.energy->size());
    term.energy->residuals(x, r.data());
    costs.push_back(term.weight * squared_sum(r, term.loss.get()));
  }
  return costs;
}

double cost(const Problem& problem, const Unknowns& x) {
  const std::vector<double> costs = cost_by_term(problem, x);
  return std::accumulate(costs.begin(), costs.end(), 0.0);
}

}  // namespace deformlab
