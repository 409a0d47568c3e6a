#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "energies/catalog.h"
#include "solvers/solver.h"
#include "tests/support/problems.h"
#include "tests/support/sparse_system.h"

namespace deformlab::test {

/// All terms that have a weight by default, at rest, with the handles aimed at `targets`.
inline Stage make_stage(const Problem& problem, const Eigen::Matrix3Xd& targets) {
  Stage stage{problem.rest(), std::vector<char>(problem.nodes(), 0), {}};
  for (const EnergyInfo& info : known_energies()) {
    if (info.default_weight == 0) continue;
    stage.terms.push_back(
        {make_energy(info.name, problem.graph, problem.handles), info.default_weight});
    stage.terms.back().energy->aim(targets);
  }
  return stage;
}

/// A plate of m nodes that is twisted and lifted at one end, moderately: every solver can.
inline Stage twisted_plate(int m, unsigned seed = 1) {
  const Problem problem = random_problem(m, 4, seed);
  return make_stage(problem, twisted(problem.handles, 0.4, 0.3));
}

inline SolverOptions gauss_newton(const std::string& linear_solver,
                                  const std::string& globalization, double epsilon = 1e-6) {
  return {.method = "gauss_newton",
          .linear_solver = linear_solver,
          .globalization = globalization,
          .epsilon = epsilon};
}
inline SolverOptions ceres_with(const std::string& linear_solver, double epsilon = 1e-6) {
  return {.method = "ceres", .linear_solver = linear_solver, .epsilon = epsilon};
}

/// Compiles and solves; the result is left in the stage.
inline Summary solve(Stage& stage, const SolverOptions& options) {
  const auto solver = make_solver(options);
  solver->compile(stage);
  return solver->solve(stage);
}

/// The term of this name.
inline WeightedEnergy& term(Stage& stage, std::string_view name) {
  return *std::ranges::find_if(stage.terms,
                               [&](const auto& one) { return one.energy->name() == name; });
}

/// The stage's residuals and Jacobian over all entries of X.
inline SparseSystem reference(const Stage& stage, const Unknowns& x) {
  std::vector<WeightedTerm> terms;
  for (const WeightedEnergy& term : stage.terms) {
    terms.push_back({term.energy.get(), term.weight, term.loss.get()});
  }
  return sparse_system(terms, x);
}

/// #free × #entries: picks the entries of free nodes, in their order.
inline Eigen::SparseMatrix<double> free_entries(const Stage& stage) {
  std::vector<Eigen::Triplet<double>> ones;
  const int d = stage.x.dimension();
  for (int j = 0; j < stage.x.nodes(); ++j) {
    for (int i = d * stage.x.first[j]; i < d * stage.x.first[j + 1] && !stage.fixed[j]; ++i) {
      ones.emplace_back(static_cast<int>(ones.size()), i, 1);
    }
  }
  Eigen::SparseMatrix<double> P(std::ssize(ones), stage.x.X.size());
  P.setFromTriplets(ones.begin(), ones.end());
  return P;
}

}  // namespace deformlab::test
