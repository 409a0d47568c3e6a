#include <gmock/gmock.h>

#include "energies/rotation_vector.h"
#include "geometry/error.h"
#include "tests/solvers/ladder.h"

// Nodes that are rotations by construction, on the rungs of the ladder.
namespace deformlab::test {
namespace {

constexpr double kTight = 1e-12;

Stage rigid_plate(int m) {
  const Problem problem = random_problem(m, 4, 1);
  const Eigen::Matrix3Xd targets = twisted(problem.handles, 0.4, 0.3);
  Stage stage{rigid_rest(problem.graph), std::vector<char>(m, 0), {}};
  for (const EnergyInfo& info : known_rigid_energies()) {
    stage.terms.push_back(
        {make_rigid_energy(info.name, problem.graph, problem.handles), info.default_weight});
    stage.terms.back().energy->aim(targets);
  }
  return stage;
}

class RigidLadder : public ::testing::TestWithParam<int> {
 protected:
  Stage stage_ = rigid_plate(GetParam());
};

TEST_P(RigidLadder, Rung1ResidualsAndDerivativesAgree) {
  expect_same_system(stage_, perturbed(stage_.x, 0.3));
  for (int j = 0; j < stage_.x.nodes(); j += 3) stage_.fixed[j] = 1;
  expect_same_system(stage_, perturbed(stage_.x, 0.3, 2));
}

TEST_P(RigidLadder, Rung2TheDenseStepIsTaken) {
  const Unknowns x = perturbed(stage_.x, 0.1);
  for (const char* name : {"cholmod", "eigen_ldlt"}) expect_dense_step(stage_, x, name);
}

TEST_P(RigidLadder, Rung3GaussNewtonAgreesWithCeres) {
  for (const char* globalization : {"levenberg", "line_search", "accelerated"}) {
    Stage stage = rigid_plate(GetParam());
    expect_same_minimum(stage, gauss_newton("cholmod", globalization, kTight),
                        ceres_with("auto", kTight));
  }
}

INSTANTIATE_TEST_SUITE_P(Nodes, RigidLadder, ::testing::Values(20, 200));

TEST(RigidNodes, AreFactoredSinceNoTermIsSeparable) {
  Stage stage = rigid_plate(40);
  const Summary summary = solve(stage, gauss_newton("auto", "accelerated"));
  EXPECT_EQ(summary.linear_solver, "cholmod");
  EXPECT_EQ(summary.choice, "no term is separable");
  try {
    solve(stage, gauss_newton("separable_cg", "accelerated"));
    ADD_FAILURE() << "separable_cg was taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("separable_cg"));
    EXPECT_THAT(e.what(), ::testing::HasSubstr("regularization, constraint"));
    EXPECT_THAT(e.what(), ::testing::HasSubstr("use auto"));
  }
}

}  // namespace
}  // namespace deformlab::test
