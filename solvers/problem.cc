#include "solvers/problem.h"

#include <fmt/format.h>

#include <numeric>

#include "energies/structure.h"
#include "geometry/core/error.h"
#include "solvers/compiled.h"

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

// Checks that x and fixed are complete.
void check_sizes(const Problem& problem) {
  const Unknowns& x = problem.x;
  const int columns = x.first.empty() ? 0 : x.first.back();
  if (columns != x.X.cols()) {
    throw InputError(
        fmt::format("the nodes of problem.x own {} columns, but X has {}; Unknowns::uniform gives "
                    "each node the same number of columns",
                    columns, x.X.cols()));
  }
  if (static_cast<int>(problem.fixed.size()) != x.nodes()) {
    throw InputError(
        fmt::format("problem.fixed has {} entries, but the problem has {} nodes; it needs one for "
                    "each node: std::vector<char>({}, 0) leaves all nodes free",
                    problem.fixed.size(), x.nodes(), x.nodes()));
  }
}

}  // namespace

void check_term(const Problem& problem, std::size_t i) {
  if (i >= problem.terms.size()) {
    throw InputError(fmt::format("there is no problem.terms[{}]; the problem has {} terms", i,
                                 problem.terms.size()));
  }
  const WeightedEnergy& term = problem.terms[i];
  if (!term.energy) {
    throw InputError(fmt::format("problem.terms[{}] has no energy; give one or erase it", i));
  }
  if (!(term.weight >= 0)) {
    throw InputError(fmt::format("the weight of the term '{}' is {}; it has to be 0 or more",
                                 term.energy->name(), term.weight));
  }
  if (!fits(*term.energy, problem.x)) {
    throw InputError(
        fmt::format("the term '{}' reads nodes that this problem does not have: check the node "
                    "indices, the dimension and the columns of its arguments",
                    term.energy->name()));
  }
  check_structure(*term.energy);
}

void check(const Problem& problem) {
  check_sizes(problem);
  for (std::size_t i = 0; i < problem.terms.size(); ++i) check_term(problem, i);
}

void check_compiled(const Problem& problem, const std::vector<int>* first, std::size_t terms) {
  if (first == nullptr) {
    throw InputError(
        "solve is called before compile: call solver->compile(problem) once, and again whenever "
        "terms or fixed nodes have changed");
  }
  const bool same_nodes = *first == problem.x.first && problem.x.X.cols() == first->back();
  if (same_nodes && problem.terms.size() == terms) return;
  throw InputError(fmt::format(
      "solve is called with {} terms on {} nodes in {} columns, but the problem that was "
      "compiled has {} terms on {} nodes in {} columns; compile this problem first",
      problem.terms.size(), problem.x.nodes(), problem.x.X.cols(), terms, first->size() - 1,
      first->back()));
}

const Energy* not_finite_term(const Problem& problem, const Unknowns& x) {
  for (const WeightedEnergy& term : problem.terms) {
    const Energy& energy = *term.energy;
    Eigen::MatrixXd r(energy.rows(), energy.size());
    Eigen::MatrixXd J(energy.rows(), Eigen::Index(energy.jacobian_columns()) * energy.size());
    energy.residuals(x, r.data());
    energy.jacobians(x, J.data());
    if (!r.allFinite() || !J.allFinite()) return &energy;
  }
  return nullptr;
}

std::string not_finite_message(const Energy& term) {
  return fmt::format("; there the term '{}' has a residual or a derivative that is not finite",
                     term.name());
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
