#include "tests/solvers/ladder.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

// Small enough that the last steps of both have died out.
constexpr double kTight = 1e-12;

class Ladder : public ::testing::TestWithParam<int> {
 protected:
  Problem problem_ = twisted_plate(GetParam());
};

TEST_P(Ladder, Rung1ResidualsAndDerivativesAgree) {
  expect_same_system(problem_, perturbed(problem_.x, 0.3));
}

TEST_P(Ladder, Rung1AgreesWithNodesFixed) {
  for (int j = 0; j < problem_.x.nodes(); j += 3) problem_.fixed[j] = 1;
  expect_same_system(problem_, perturbed(problem_.x, 0.3, 2));
}

TEST_P(Ladder, Rung3LevenbergMarquardtAgreesWithCeres) {
  expect_same_minimum(problem_, gauss_newton("cholmod", "levenberg", kTight),
                      ceres_with("auto", kTight));
}

TEST_P(Ladder, Rung3CholmodAgreesWithEigen) {
  expect_same_minimum(problem_, gauss_newton("cholmod", "line_search", kTight),
                      gauss_newton("eigen_ldlt", "line_search", kTight));
}

TEST_P(Ladder, Rung3ConjugateGradientsAgreeWithCholmod) {
  expect_same_minimum(problem_, gauss_newton("cholmod", "line_search", kTight),
                      gauss_newton("kronecker_cg", "line_search", kTight));
}

TEST_P(Ladder, Rung3AcceleratedStepsAgreeWithHalvedOnes) {
  for (const char* linear_solver : {"cholmod", "kronecker_cg"}) {
    Problem problem = twisted_plate(GetParam());
    expect_same_minimum(problem, gauss_newton("cholmod", "line_search", kTight),
                        gauss_newton(linear_solver, "accelerated", kTight));
  }
}

INSTANTIATE_TEST_SUITE_P(Nodes, Ladder, ::testing::Values(20, 200, 1000));

class DenseStep : public ::testing::TestWithParam<int> {};

TEST_P(DenseStep, Rung2IsTaken) {
  Problem problem = twisted_plate(GetParam());
  const Unknowns x = perturbed(problem.x, 0.1);
  for (const char* name : {"cholmod", "eigen_ldlt"}) expect_dense_step(problem, x, name);
  for (int j = 0; j < problem.x.nodes(); j += 4) problem.fixed[j] = 1;
  for (const char* name : {"cholmod", "eigen_ldlt"}) expect_dense_step(problem, x, name);
}

INSTANTIATE_TEST_SUITE_P(Nodes, DenseStep, ::testing::Values(20, 200));

// Rung 4: far from well posed, the methods may end in different minima, and do. What each of them
// says about its own end has to be true.
TEST(LadderTop, EveryMethodIsHonestOnAHardScene) {
  const Sample sample = random_sample(60);
  const Eigen::Matrix3Xd targets = twisted(sample.handles, 2.5, 6);
  SolverOptions dogleg = ceres_with("auto");
  dogleg.ceres_trust_region = CeresTrustRegion::kDogleg;
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "none"), gauss_newton("cholmod", "line_search"),
        gauss_newton("cholmod", "levenberg"), gauss_newton("cholmod", "accelerated"),
        gauss_newton("kronecker_cg", "accelerated"), ceres_with("auto"), dogleg}) {
    Problem problem = make_problem(sample, targets);
    for (WeightedEnergy& term : problem.terms) {
      if (term.energy->name() != "rotation")
        term.weight *= 1e-3;  // as if lengths were in a large unit
    }
    const Summary summary = solve(problem, options);
    const std::string name = summary.method + "_" + summary.globalization;
    RecordProperty(name + "_cost", std::to_string(summary.final_cost));
    RecordProperty(name + "_status", to_string(summary.status));
    EXPECT_TRUE(problem.x.X.allFinite()) << name;
    EXPECT_NEAR(summary.final_cost, cost(problem, problem.x), 1e-9 * summary.final_cost) << name;
    EXPECT_NE(summary.message, "") << name;
    if (summary.status == Status::kConverged) {
      const SparseSystem system = reference(problem, problem.x);
      EXPECT_LT(2 * system.Jtr().lpNorm<Eigen::Infinity>(), 0.01 * (1 + summary.final_cost))
          << name;
    }
    if (options.globalization != "none") {
      EXPECT_LT(summary.final_cost, summary.initial_cost) << name;
    }
  }
}

// x of node j in one numbering is x of node order[j] in the other.
TEST(Numbering, OfTheNodesDoesNotMatter) {
  const int m = 40;
  const Eigen::Vector3d size(3, 1, 0.3);
  const Eigen::Matrix3Xd g = random_points(m, size, 1), v = random_points(15 * m, size, 2);
  std::vector<int> order(m);
  for (int j = 0; j < m; ++j) order[j] = (7 * j + 3) % m;
  Eigen::Matrix3Xd renumbered(3, m);
  for (int j = 0; j < m; ++j) renumbered.col(order[j]) = g.col(j);
  const Sample one = make_sample(g, v, 4), other = make_sample(renumbered, v, 4);
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "line_search", kTight), ceres_with("auto", kTight)}) {
    Problem a = make_problem(one, twisted(one.handles, 0.4, 0.3));
    Problem b = make_problem(other, twisted(other.handles, 0.4, 0.3));
    const Summary s = solve(a, options), t = solve(b, options);
    EXPECT_LT(std::abs(s.final_cost - t.final_cost), 1e-9 * s.final_cost);
    for (int j = 0; j < m; ++j) {
      const Eigen::Matrix<double, 3, 4> difference =
          a.x.X.middleCols<4>(4 * j) - b.x.X.middleCols<4>(4 * order[j]);
      EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace deformlab::test
