// Extracted from CONTRIBUTING.md when the tests are configured.
#include "energies/term_energy.h"
#include "energies/volume.h"
#include "tests/solvers/ladder.h"

namespace deformlab::test {
namespace {

Stage plate_that_keeps_its_volume() {
  const Problem problem = random_problem(40);
  Stage stage = make_stage(problem, twisted(problem.handles, 0.4, 0.3));
  stage.terms.push_back({std::make_unique<TermEnergy<Volume<>>>(Volume<>::over(problem.graph)), 5});
  return stage;
}

TEST(VolumeTerm, GoesThroughBothSolvers) {
  Stage stage = plate_that_keeps_its_volume();
  expect_same_system(stage, perturbed(stage.x, 0.3));
  expect_dense_step(stage, perturbed(stage.x, 0.1), "cholmod");
  stage = plate_that_keeps_its_volume();
  expect_same_minimum(stage, gauss_newton("cholmod", "levenberg", 1e-12),
                      ceres_with("auto", 1e-12));
}

}  // namespace
}  // namespace deformlab::test
