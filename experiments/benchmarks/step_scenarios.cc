#include <utility>

#include "experiments/benchmarks/scenarios.h"
#include "experiments/benchmarks/ways.h"

namespace deformlab {
namespace {

// This globalization is the closest to Ceres' trust region: both take full steps where they can.
SolverOptions our_options() {
  SolverOptions options = cholmod_options();
  options.globalization = "line_search";
  return options;
}

}  // namespace

std::vector<Scenario> step_scenarios() {
  const std::vector<int> all = {222, 425, 1048};
  const std::vector<int> small = {222, 425};  // larger graphs would take minutes
  const auto lm = CeresTrustRegion::kLevenbergMarquardt, dogleg = CeresTrustRegion::kDogleg;
  const std::pair<SolverOptions, std::vector<int>> configurations[] = {
      {ceres_options("sparse_normal_cholesky", CeresBlocks::kColumn, lm), all},
      {ceres_options("sparse_normal_cholesky", CeresBlocks::kColumn, dogleg), all},
      {ceres_options("sparse_normal_cholesky", CeresBlocks::kNode, lm), all},
      {ceres_options("sparse_normal_cholesky", CeresBlocks::kNode, dogleg), all},
      {ceres_options("cgnr", CeresBlocks::kNode, lm), all},
      {ceres_options("cgnr", CeresBlocks::kColumn, lm), all},
      {ceres_options("iterative_schur", CeresBlocks::kNode, lm), small},
      {ceres_options("sparse_schur", CeresBlocks::kNode, lm), all},
      {ceres_options("sparse_schur", CeresBlocks::kColumn, lm), small},
      {ceres_options("sparse_normal_cholesky", CeresBlocks::kColumn, lm,
                     CeresSparseLibrary::kEigenSparse),
       small},
      {ceres_options("sparse_normal_cholesky", CeresBlocks::kColumn, lm,
                     CeresSparseLibrary::kCxSparse),
       small},
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
