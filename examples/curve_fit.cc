// The fit of a curve: y = a exp(−b t) cos(c t) through 100 noisy measurements, of which some are
// wrong altogether. A robust loss keeps these from spoiling the fit.
//
// There is one node, the column (a, b, c). An element is one measurement.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "energies/term_energy.h"
#include "solvers/loss.h"
#include "solvers/solver.h"

using namespace deformlab;

template <class T>
T curve(const Vector<T, 3>& p, double t) {
  using std::cos, std::exp;
  return p[0] * exp(-p[1] * t) * cos(p[2] * t);
}

struct Measurement {
  static constexpr std::string_view kName = "measurement";
  double t, y;

  template <class T>
  Vector<T, 1> operator()(const Vector<T, 3>& parameters) const {
    return Vector<T, 1>(curve(parameters, t) - y);
  }
};

int main() {
  const Eigen::Vector3d truth(2, 0.4, 3), guess(1, 0.1, 2.8);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.02);
  Terms<Measurement> sum;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.05 * i, wrong = i % 10 == 7 ? 1.5 : 0;
    sum.add({t, curve<double>(truth, t) + noise(random) + wrong}, {0});
  }

  Problem problem{Unknowns::uniform(guess, 1), {0}, {}};
  problem.terms.push_back(
      {to_energy(sum), 1, make_loss({.kind = LossKind::kCauchy, .scale = 0.1})});
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    problem.x.X = guess;
    const auto solver = make_solver({.method = method, .epsilon = 1e-10});
    solver->compile(problem);
    const Summary summary = solver->solve(problem);
    const auto p = problem.x.X.col(0);
    fmt::print("{}: cost {:.12g} after {} steps, from {:.4g}; a = {:.3f}, b = {:.3f}, c = {:.3f}\n",
               name_of(method), summary.final_cost, summary.iterations.size(), summary.initial_cost,
               p[0], p[1], p[2]);
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}
