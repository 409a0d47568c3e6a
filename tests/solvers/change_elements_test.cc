#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/core/error.h"
#include "solvers/gauss_newton/linearization/linearization.h"
#include "solvers/gauss_newton/step_solvers/step_solver.h"
#include "solvers/solver.h"
#include "tests/support/problems.h"

namespace deformlab::test {
namespace {

Sample with_handles(Sample sample, const std::vector<int>& chosen) {
  sample.handles = subset(sample.handles, chosen);
  return sample;
}

std::vector<int> numbers(int first, int last) {
  std::vector<int> result;
  for (int i = first; i < last; ++i) result.push_back(i);
  return result;
}

Problem problem_of(const Sample& sample) {
  const bool none = sample.handles.v.cols() == 0;
  return make_problem(sample, none ? sample.handles.v : twisted(sample.handles, 0.4, 0.3));
}

// Gives `problem` the handles of another one.
std::size_t replace_handles(Problem& problem, const Sample& sample) {
  const std::size_t i = index_of_term(problem, "constraint");
  problem.terms[i] = std::move(problem_of(sample).terms[i]);
  return i;
}

// As many steps as rounding allows.
SolverOptions to_the_end(const std::string& linear_solver) {
  SolverOptions options = gauss_newton(linear_solver, "accelerated", 1e-24);
  options.max_iterations = 60;
  return options;
}

const Sample kAll = random_sample(60);
const int kHandles = static_cast<int>(kAll.handles.v.cols());

TEST(ChangeElements, AFollowsTheElements) {
  Problem problem = problem_of(with_handles(kAll, numbers(0, kHandles - 3)));
  problem.fixed[5] = 1;
  Linearization changed(problem, ColumnOrder::kAsGiven);
  const std::size_t i = replace_handles(problem, with_handles(kAll, numbers(4, kHandles)));
  ASSERT_TRUE(changed.change_elements(problem, i));
  EXPECT_EQ(changed.change_of_A().rank(), 7);
  EXPECT_EQ(changed.change_of_A().negative(), 4);
  const Linearization fresh(problem, ColumnOrder::kAsGiven);
  const int n = fresh.columns().count();
  const Eigen::MatrixXd difference =
      changed.A() + changed.change_of_A().lower(n) - Eigen::MatrixXd(fresh.A());
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(changed.evaluate(problem.x),
              Linearization(problem, ColumnOrder::kAsGiven).evaluate(problem.x), 1e-9);
}

TEST(ChangeElements, AChangeThatIsTakenBackVanishes) {
  Problem problem = problem_of(kAll);
  Linearization linearization(problem, ColumnOrder::kFillReducing);
  for (const auto& [first, rank] : {std::pair(3, 3), {1, 1}, {5, 5}, {0, 0}}) {
    const std::size_t i = replace_handles(problem, with_handles(kAll, numbers(first, kHandles)));
    ASSERT_TRUE(linearization.change_elements(problem, i));
    EXPECT_EQ(linearization.change_of_A().rank(), rank);
  }
}

TEST(ChangeElements, TheMinimumIsThatOfAFullCompilation) {
  Problem problem = problem_of(with_handles(kAll, numbers(0, kHandles - 4)));
  const auto solver = make_solver(to_the_end("kronecker_cg"));
  solver->compile(problem);
  solver->solve(problem);
  const std::size_t i = replace_handles(problem, with_handles(kAll, numbers(3, kHandles)));
  ASSERT_TRUE(solver->change_elements(problem, i));
  const Summary changed = solver->solve(problem);
  const Eigen::MatrixXd X = problem.x.X;
  solver->compile(problem);
  problem.x = problem_of(kAll).x;
  const Summary fresh = solver->solve(problem);
  EXPECT_NEAR(changed.final_cost, fresh.final_cost, 1e-9 * fresh.final_cost);
  EXPECT_LE((problem.x.X - X).cwiseAbs().maxCoeff(), 1e-9);
}

// The factorization that auto falls back to has to see the changed A.
TEST(ChangeElements, AFactorizationAfterAChangeSeesIt) {
  Problem problem = problem_of(with_handles(kAll, numbers(0, kHandles - 4)));
  Linearization linearization(problem, ColumnOrder::kFillReducing);
  const std::size_t i = replace_handles(problem, kAll);
  ASSERT_TRUE(linearization.change_elements(problem, i));
  const auto steps = make_step_solver("cholmod");
  steps->compile(linearization);
  linearization.evaluate(problem.x);
  linearization.linearize(problem.x);
  steps->update(linearization);
  Eigen::VectorXd D = Eigen::VectorXd::Zero(linearization.unknowns());
  Eigen::VectorXd delta = D, exact = D;
  ASSERT_TRUE(steps->direction(linearization, 0, D, delta).regular);
  Linearization fresh(problem, ColumnOrder::kFillReducing);
  fresh.evaluate(problem.x);
  fresh.linearize(problem.x);
  steps->compile(fresh);
  steps->update(fresh);
  ASSERT_TRUE(steps->direction(fresh, 0, D, exact).regular);
  Eigen::MatrixXd a(problem.x.X.rows(), problem.x.X.cols()), b = a;
  for (int c = 0; c < a.cols(); ++c) {
    for (int row = 0; row < a.rows(); ++row) {
      a(row, c) = delta[linearization.columns().unknown(row, c)];
      b(row, c) = exact[fresh.columns().unknown(row, c)];
    }
  }
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ChangeElements, AreRefusedWhereACompilationIsNeeded) {
  const Sample few = with_handles(kAll, {0, 1, 2, 3});
  Problem problem = problem_of(few);
  const auto solver = make_solver(to_the_end("kronecker_cg"));
  const std::size_t i = index_of_term(problem, "constraint");
  EXPECT_FALSE(solver->change_elements(problem, i)) << "nothing is compiled";
  solver->compile(problem);
  EXPECT_TRUE(solver->change_elements(problem, i)) << "nothing has changed";
  replace_handles(problem, with_handles(kAll, numbers(0, 13)));
  EXPECT_FALSE(solver->change_elements(problem, i)) << "nine handles are new";
  EXPECT_THROW(solver->solve(problem), InputError) << "it is not compiled";
  replace_handles(problem, few);
  solver->compile(problem);
  replace_handles(problem, with_handles(kAll, {}));
  EXPECT_FALSE(solver->change_elements(problem, i)) << "no handle is left, so A is singular";
  EXPECT_THROW(solver->solve(problem), InputError) << "it is not compiled";
  replace_handles(problem, few);
  solver->compile(problem);
  EXPECT_FALSE(solver->change_elements(problem, i == 0 ? 1 : 0)) << "a nonlinear term";
  EXPECT_THROW(solver->change_elements(problem, problem.terms.size()), InputError);
  for (const SolverOptions& options :
       {gauss_newton("cholmod", "line_search"), ceres_with("auto")}) {
    const auto other = make_solver(options);
    other->compile(problem);
    EXPECT_FALSE(other->change_elements(problem, i)) << options.linear_solver;
  }
}

}  // namespace
}  // namespace deformlab::test
