#include <gtest/gtest.h>

// Extracted from CONTRIBUTING.md when the tests are configured.
#include "energies/graph/volume.h"
#include "energies/term_energy.h"
#include "tests/solvers/ladder.h"

namespace deformlab::test {
namespace {

Problem plate_that_keeps_its_volume() {
  const Sample sample = random_sample(40);
  Problem problem = make_problem(sample, twisted(sample.handles, 0.4, 0.3));
  problem.terms.push_back({to_energy(Volume<>::over(sample.context())), 5});
  return problem;
}

TEST(VolumeTerm, GoesThroughBothSolvers) {
  Problem problem = plate_that_keeps_its_volume();
  expect_same_system(problem, perturbed(problem.x, 0.3));
  expect_dense_step(problem, perturbed(problem.x, 0.1), "cholmod");
  problem = plate_that_keeps_its_volume();
  expect_same_minimum(problem, gauss_newton("cholmod", "levenberg", 1e-12),
                      ceres_with("auto", 1e-12));
}

}  // namespace
}  // namespace deformlab::test
