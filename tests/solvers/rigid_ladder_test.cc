#include <gmock/gmock.h>

#include "energies/catalog.h"
#include "geometry/core/error.h"
#include "tests/solvers/ladder.h"

// Nodes that are rotations by construction, on the rungs of the ladder.
namespace deformlab::test {
namespace {

constexpr double kTight = 1e-12;

Problem rigid_plate(int m) {
  const Sample sample = random_sample(m, 4, 1);
  const Eigen::Matrix3Xd targets = twisted(sample.handles, 0.4, 0.3);
  Problem problem{sample.rest<RigidNode>(), std::vector<char>(m, 0), {}};
  for (const EnergyInfo& info : known_energies()) {
    if (!info.for_rigid_nodes || info.default_weight == 0) continue;
    problem.terms.push_back(
        {make_energy(info.name, sample.context(3, NodeModel::kRigid)), info.default_weight});
    problem.terms.back().energy->set_targets(targets);
  }
  return problem;
}

class RigidLadder : public ::testing::TestWithParam<int> {
 protected:
  Problem problem_ = rigid_plate(GetParam());
};

TEST_P(RigidLadder, Rung1ResidualsAndDerivativesAgree) {
  expect_same_system(problem_, perturbed(problem_.x, 0.3));
  for (int j = 0; j < problem_.x.nodes(); j += 3) problem_.fixed[j] = 1;
  expect_same_system(problem_, perturbed(problem_.x, 0.3, 2));
}

TEST_P(RigidLadder, Rung2TheDenseStepIsTaken) {
  const Unknowns x = perturbed(problem_.x, 0.1);
  for (const char* name : {"cholmod", "eigen_ldlt"}) expect_dense_step(problem_, x, name);
}

TEST_P(RigidLadder, Rung3GaussNewtonAgreesWithCeres) {
  for (const char* globalization : {"levenberg", "line_search", "accelerated"}) {
    Problem problem = rigid_plate(GetParam());
    expect_same_minimum(problem, gauss_newton("cholmod", globalization, kTight),
                        ceres_with("auto", kTight));
  }
}

INSTANTIATE_TEST_SUITE_P(Nodes, RigidLadder, ::testing::Values(20, 200));

TEST(RigidNodes, AreFactoredSinceNoTermIsSeparable) {
  Problem problem = rigid_plate(40);
  const Summary summary = solve(problem, gauss_newton("auto", "accelerated"));
  EXPECT_EQ(summary.linear_solver, "cholmod");
  EXPECT_EQ(summary.choice, "no term is Kronecker");
  try {
    solve(problem, gauss_newton("kronecker_cg", "accelerated"));
    ADD_FAILURE() << "kronecker_cg was taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("kronecker_cg"));
    EXPECT_THAT(e.what(), ::testing::HasSubstr("regularization, constraint"));
    EXPECT_THAT(e.what(), ::testing::HasSubstr("use auto"));
  }
}

}  // namespace
}  // namespace deformlab::test
