#include <gmock/gmock.h>

// The next two are extracted from CONTRIBUTING.md when the tests are configured.
#include "solvers/gauss_newton/globalization/nonmonotone.h"
#include "solvers/linear/dense_cholesky.h"
#include "tests/solvers/ladder.h"
#include "tests/support/errors.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kTight = 1e-12;

class Registered : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
#include "register_solvers.inc"
  }
};

TEST_F(Registered, LinearSolverTakesTheDenseStep) {
  EXPECT_THAT(step_solver_names(), Contains("dense_cholesky"));
  Problem problem = twisted_plate(20);
  expect_dense_step(problem, perturbed(problem.x, 0.1), "dense_cholesky");
}

TEST_F(Registered, LinearSolverFindsTheMinimum) {
  Problem problem = twisted_plate(20);
  expect_same_minimum(problem, gauss_newton("cholmod", "line_search", kTight),
                      gauss_newton("dense_cholesky", "line_search", kTight));
  const Summary s = solve(problem, gauss_newton("dense_cholesky", "accelerated"));
  EXPECT_EQ(s.linear_solver, "dense_cholesky");
}

TEST_F(Registered, GlobalizationFindsTheMinimum) {
  EXPECT_THAT(globalization_names(), Contains("nonmonotone"));
  for (const char* linear_solver : {"cholmod", "kronecker_cg"}) {
    Problem problem = twisted_plate(20);
    expect_same_minimum(problem, gauss_newton("cholmod", "line_search", kTight),
                        gauss_newton(linear_solver, "nonmonotone", kTight));
  }
}

TEST_F(Registered, NamesAreUnique) {
  const auto dense = [](int) { return std::make_unique<DenseCholesky>(); };
  for (const char* name : {"dense_cholesky", "cholmod", "auto", "kronecker_cg"}) {
    EXPECT_THAT(error_of([&] { register_linear_solver(name, dense); }),
                HasSubstr("'" + std::string(name) + "' already"));
  }
  EXPECT_THAT(error_of([&] { register_step_solver("cholmod", nullptr); }), HasSubstr("already"));
  EXPECT_THAT(error_of([] { register_globalization("", nullptr); }), HasSubstr("needs a name"));
  EXPECT_THAT(error_of([] { register_globalization("new", nullptr); }), HasSubstr("a factory"));
}

TEST_F(Registered, UnknownNamesListTheRegisteredOnes) {
  EXPECT_THAT(error_of([] { make_globalization("armijo"); }),
              HasSubstr("'armijo'; known: none, line_search, levenberg, accelerated, nonmonotone"));
}

}  // namespace
}  // namespace deformlab::test
