#include <utility>

#include "experiments/benchmarks/scenarios.h"
#include "experiments/benchmarks/ways.h"

namespace deformlab {
namespace {

// The same globalization as Ceres' trust region is the closest: both take full steps where they
// can.
SolverOptions our_options() {
  SolverOptions options = cholmod_options();
  options.globalization = "line_search";
  return options;
}

}  // namespace

std::vector<Scenario> step_scenarios() {
  const std::vector<int> all = {222, 425, 1048};
  const std::vector<int> small = {222, 425};  // larger graphs would take minutes
  const char *lm = "levenberg_marquardt", *dogleg = "dogleg";
  const std::pair<SolverOptions, std::vector<int>> configurations[] = {
      {ceres_options("sparse_normal_cholesky", "column", lm), all},
      {ceres_options("sparse_normal_cholesky", "column", dogleg), all},
      {ceres_options("sparse_normal_cholesky", "node", lm), all},
      {ceres_options("sparse_normal_cholesky", "node", dogleg), all},
      {ceres_options("cgnr", "node", lm), all},
      {ceres_options("cgnr", "column", lm), all},
      {ceres_options("iterative_schur", "node", lm), small},
      {ceres_options("sparse_schur", "node", lm), all},
      {ceres_options("sparse_schur", "column", lm), small},
      {ceres_options("sparse_normal_cholesky", "column", lm, "eigen_sparse"), small},
      {ceres_options("sparse_normal_cholesky", "column", lm, "cx_sparse"), small},
  };
  std::vector<Scenario> result;
  for (const auto& [options, sizes] : configurations) {
    result.push_back({"a step of CHOLMOD", describe(options), "nodes", sizes,
                      [](int nodes) { return step(nodes, our_options()); },
                      [options = options](int nodes) { return step(nodes, options); }});
  }
  return result;
}

std::vector<Scenario> scenarios() {
  std::vector<Scenario> all = edit_scenarios();
  for (const auto& more : {step_scenarios(), drawing_scenarios()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace deformlab
