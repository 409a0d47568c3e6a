#include "tests/support/problems.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "energies/catalog.h"

namespace deformlab::test {

Problem make_problem(const Sample& sample, const Eigen::Matrix3Xd& targets) {
  Problem problem{sample.rest(), std::vector<char>(sample.nodes(), 0), {}};
  for (const EnergyInfo& info : known_energies()) {
    if (info.default_weight == 0) continue;
    problem.terms.push_back({make_energy(info.name, sample.context()), info.default_weight});
    problem.terms.back().energy->set_targets(targets);
  }
  return problem;
}

Problem twisted_plate(int m, unsigned seed) {
  const Sample sample = random_sample(m, 4, seed);
  return make_problem(sample, twisted(sample.handles, 0.4, 0.3));
}

SolverOptions gauss_newton(const std::string& linear_solver, const std::string& globalization,
                           double epsilon) {
  return {.method = SolverMethod::kGaussNewton,
          .linear_solver = linear_solver,
          .globalization = globalization,
          .epsilon = epsilon};
}

SolverOptions ceres_with(const std::string& linear_solver, double epsilon) {
  return {.method = SolverMethod::kCeres, .linear_solver = linear_solver, .epsilon = epsilon};
}

Summary solve(Problem& problem, const SolverOptions& options) {
  const auto solver = make_solver(options);
  solver->compile(problem);
  return solver->solve(problem);
}

std::size_t index_of_term(const Problem& problem, std::string_view name) {
  const auto found = std::ranges::find_if(
      problem.terms, [&](const auto& one) { return one.energy->name() == name; });
  return found - problem.terms.begin();
}

WeightedEnergy& term(Problem& problem, std::string_view name) {
  return problem.terms[index_of_term(problem, name)];
}

SparseSystem reference(const Problem& problem, const Unknowns& x) {
  std::vector<WeightedTerm> terms;
  for (const WeightedEnergy& term : problem.terms) {
    terms.push_back({term.energy.get(), term.weight, term.loss.get()});
  }
  return sparse_system(terms, x);
}

Eigen::SparseMatrix<double> free_entries(const Problem& problem) {
  std::vector<Eigen::Triplet<double>> ones;
  const int d = problem.x.dimension();
  for (int j = 0; j < problem.x.nodes(); ++j) {
    for (int i = d * problem.x.first[j]; i < d * problem.x.first[j + 1] && !problem.fixed[j]; ++i) {
      ones.emplace_back(static_cast<int>(ones.size()), i, 1);
    }
  }
  Eigen::SparseMatrix<double> P(std::ssize(ones), problem.x.X.size());
  P.setFromTriplets(ones.begin(), ones.end());
  return P;
}

}  // namespace deformlab::test
