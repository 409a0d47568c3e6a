#include <gmock/gmock.h>

#include "tests/solvers/ladder.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

class SeparableCg : public ::testing::TestWithParam<int> {
 protected:
  void expect_the_minimum_of_a_factorization(const std::string& globalization) {
    Stage direct = twisted_plate(GetParam()), inexact = twisted_plate(GetParam());
    for (int j = 0; j < direct.x.nodes() && fixed_; j += 5) direct.fixed[j] = inexact.fixed[j] = 1;
    const Summary expected = solve(direct, gauss_newton("cholmod", globalization));
    const Summary s = solve(inexact, gauss_newton("separable_cg", globalization));
    EXPECT_EQ(s.status, Status::kConverged);
    EXPECT_NEAR(s.final_cost, expected.final_cost, 1e-6 * expected.final_cost);
    EXPECT_EQ(s.factorizations, 0);
    EXPECT_GT(s.cg_iterations, 0);
    EXPECT_LT(s.nonzeros_factor, expected.nonzeros_factor);
  }

  bool fixed_ = false;
};

TEST_P(SeparableCg, FindsTheMinimumOfAFactorization) {
  expect_the_minimum_of_a_factorization("line_search");
}

TEST_P(SeparableCg, FindsItDamped) { expect_the_minimum_of_a_factorization("levenberg"); }

TEST_P(SeparableCg, FindsItWithNodesFixed) {
  fixed_ = true;
  expect_the_minimum_of_a_factorization("line_search");
}

INSTANTIATE_TEST_SUITE_P(Nodes, SeparableCg, ::testing::Values(20, 200, 1000));

// With separable terms alone the preconditioner is the matrix itself.
TEST(SeparableCgPreconditioner, IsExactForSeparableTerms) {
  Stage stage = twisted_plate(50);
  std::erase_if(stage.terms, [](const WeightedEnergy& term) {
    return term.energy->structure() != Structure::kSeparable;
  });
  ASSERT_EQ(stage.terms.size(), 2u);
  const Summary s = solve(stage, gauss_newton("separable_cg", "line_search"));
  EXPECT_EQ(s.status, Status::kConverged);
  EXPECT_LE(s.iterations.size(), 2u);
  EXPECT_LE(s.cg_iterations, 2);
}

TEST(SeparableCgPreconditioner, TakesAStageWhereEveryNodeIsFixed) {
  Stage stage = twisted_plate(20);
  stage.fixed.assign(stage.fixed.size(), 1);
  const Summary s = solve(stage, gauss_newton("separable_cg", "line_search"));
  EXPECT_EQ(s.status, Status::kConverged);
  EXPECT_THAT(s.message, HasSubstr("every node is fixed"));
}

TEST(SeparableCgPreconditioner, TakesAProblemWithoutAnyHandle) {
  Stage stage = twisted_plate(20);
  std::erase_if(stage.terms,
                [](const WeightedEnergy& term) { return term.energy->name() == "constraint"; });
  stage.x = perturbed(stage.x, 0.05);
  const Summary s = solve(stage, gauss_newton("separable_cg", "line_search"));
  EXPECT_TRUE(std::isfinite(s.final_cost));
  EXPECT_LT(s.final_cost, 1e-3 * s.initial_cost);
  EXPECT_TRUE(stage.x.X.allFinite());
}

}  // namespace
}  // namespace deformlab::test
