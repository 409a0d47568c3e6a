#pragma once

#include <string>
#include <vector>

#include "solvers/options.h"

namespace deformlab {

/// The share of Ceres' time a step that the hand-written CHOLMOD path may take.
inline constexpr double kAllowedRatio = 0.6;

/// One way to solve the reference scene, measured in turns with the hand-written path.
struct Contender {
  std::string name;
  SolverOptions options;
  int most_nodes;  ///< left out of larger graphs, where it would take minutes

  std::string status;
  std::string blas;
  std::size_t steps = 0;
  double cost = 0;
  std::vector<double> step_ms, ours_ms;         ///< of a step, pair by pair
  std::vector<double> solve_ms, ours_solve_ms;  ///< compilation and all steps

  bool same_minimum = false;            ///< of the hand-written path, to 1e-6 relative
  double ratio(double quantile) const;  ///< of ours_ms / step_ms
};

/// The hand-written path beside every configuration of Ceres that makes sense, on one graph.
struct Comparison {
  int nodes = 0;
  std::size_t our_steps = 0;
  double our_cost = 0;
  std::string our_blas;
  std::vector<Contender> ceres;  ///< fastest step first
  bool holds() const;            ///< the best of those at the same minimum against kAllowedRatio
  const Contender& best() const;
};

/// Solves in turns, ours before each of theirs, so that what else the machine does hits both. The
/// fastest configurations are measured `repetitions` times, the others once.
Comparison compare(int nodes, int repetitions);

/// A Markdown table, and a line that gives the verdict.
std::string to_markdown(const Comparison& comparison);

}  // namespace deformlab
