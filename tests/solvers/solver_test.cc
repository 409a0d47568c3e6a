#include "solvers/solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/core/error.h"
#include "tests/support/errors.h"
#include "tests/support/problems.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

std::string error_of(const SolverOptions& options) {
  return test::error_of([&] { make_solver(options); });
}

std::vector<SolverOptions> every_method() {
  return {gauss_newton("cholmod", "none"),
          gauss_newton("cholmod", "line_search"),
          gauss_newton("cholmod", "levenberg"),
          gauss_newton("kronecker_cg", "none"),
          gauss_newton("kronecker_cg", "line_search"),
          gauss_newton("kronecker_cg", "levenberg"),
          gauss_newton("eigen_ldlt", "none"),
          gauss_newton("eigen_ldlt", "line_search"),
          gauss_newton("eigen_ldlt", "levenberg"),
          ceres_with("auto")};
}

std::string name_of(const SolverOptions& o) {
  return std::string(deformlab::name_of(o.method)) + " " + o.linear_solver + " " + o.globalization;
}

class CeresLinearSolver : public ::testing::TestWithParam<const char*> {};

TEST_P(CeresLinearSolver, FindsTheMinimum) {
  Problem problem = twisted_plate(20);
  const Unknowns start = problem.x;
  const double best = solve(problem, gauss_newton("cholmod", "levenberg", 1e-12)).final_cost;
  problem.x = start;
  const Summary summary = solve(problem, ceres_with(GetParam(), 1e-9));
  // Ceres' conjugate gradients stop early: their steps are inexact, so they end less close.
  const bool iterative =
      summary.linear_solver == "CGNR" || summary.linear_solver == "ITERATIVE_SCHUR";
  EXPECT_EQ(summary.status, Status::kConverged) << summary.message;
  EXPECT_LT(summary.final_cost, (1 + (iterative ? 1e-4 : 1e-8)) * best);
  EXPECT_GT(summary.final_cost, (1 - 1e-9) * best);
}

INSTANTIATE_TEST_SUITE_P(Each, CeresLinearSolver,
                         ::testing::Values("auto", "dense_qr", "dense_normal_cholesky",
                                           "sparse_normal_cholesky", "dense_schur", "sparse_schur",
                                           "iterative_schur", "cgnr"));

TEST(CeresOptions, AllFindTheSameMinimum) {
  SolverOptions dogleg = ceres_with("auto", 1e-9), eigen = dogleg, nodes = dogleg;
  dogleg.ceres_trust_region = CeresTrustRegion::kDogleg;
  eigen.ceres_sparse_library = CeresSparseLibrary::kEigenSparse;
  nodes.ceres_blocks = CeresBlocks::kNode;
  for (const SolverOptions& options : {dogleg, eigen, nodes}) {
    Problem problem = twisted_plate(20);
    const Unknowns start = problem.x;
    const double best = solve(problem, gauss_newton("cholmod", "levenberg", 1e-12)).final_cost;
    problem.x = start;
    EXPECT_NEAR(solve(problem, options).final_cost, best, 1e-8 * best);
  }
}

TEST(SolverOptions, UnknownNamesAreErrorsThatListTheKnownOnes) {
  EXPECT_THAT(error_of(gauss_newton("umfpack", "none")),
              HasSubstr("linear_solver is 'umfpack'; known: auto, cholmod, eigen_ldlt"));
  EXPECT_THAT(error_of(gauss_newton("cgnr", "none")),
              HasSubstr("linear_solver is 'cgnr', which is not one of gauss_newton's; known: auto, "
                        "cholmod, eigen_ldlt"));
  EXPECT_THAT(error_of(gauss_newton("cholmod", "armijo")),
              HasSubstr("'armijo'; known: none, line_search, levenberg"));
  EXPECT_THAT(error_of(ceres_with("cholmod")), HasSubstr("known: auto, dense_qr"));
}

TEST(SolverOptions, NumbersOutOfRangeAreErrors) {
  for (const double epsilon : {0., -1., 1., double(NAN)}) {
    EXPECT_THAT(error_of({.epsilon = epsilon}), HasSubstr("epsilon is "));
  }
  EXPECT_THAT(error_of({.max_iterations = 0}),
              HasSubstr("max_iterations is 0; allowed: at least 1"));
}

std::string error_of_solve(const SolverOptions& options, Problem& problem, bool compile) {
  const auto solver = make_solver(options);
  return test::error_of([&] {
    if (compile) solver->compile(problem);
    solver->solve(problem);
  });
}

TEST(Misuse, IsRefusedWithTheMistakeAndTheCure) {
  for (const SolverOptions& options :
       {gauss_newton("auto", "accelerated"), gauss_newton("cholmod", "none"), ceres_with("auto")}) {
    Problem problem = twisted_plate(20);
    EXPECT_THAT(error_of_solve(options, problem, false), HasSubstr("call solver->compile"));
    problem.fixed.clear();
    EXPECT_THAT(error_of_solve(options, problem, true),
                HasSubstr("problem.fixed has 0 entries, but the problem has 20 nodes"));
    problem.fixed.resize(21);
    EXPECT_THAT(error_of_solve(options, problem, true), HasSubstr("std::vector<char>(20, 0)"));
    problem.fixed.resize(20);
    problem.terms.front().weight = -1;
    EXPECT_THAT(error_of_solve(options, problem, true), HasSubstr("is -1; it has to be 0 or more"));
    problem = twisted_plate(20);
    problem.terms.emplace_back();
    EXPECT_THAT(error_of_solve(options, problem, true), HasSubstr("has no energy"));
    problem = twisted_plate(20);
    problem.x.first.pop_back();
    EXPECT_THAT(error_of_solve(options, problem, true), HasSubstr("own 76 columns, but X has 80"));
  }
}

TEST(Misuse, OfASolverForAnotherProblemIsRefused) {
  for (const SolverOptions& options : {gauss_newton("auto", "accelerated"), ceres_with("auto")}) {
    Problem problem = twisted_plate(20), other = twisted_plate(21);
    const auto solver = make_solver(options);
    solver->compile(problem);
    EXPECT_THROW(solver->solve(other), InputError);
    problem.terms.pop_back();
    EXPECT_THROW(solver->solve(problem), InputError);
  }
}

TEST(EveryMethod, StaysAtRestAtRest) {
  for (const SolverOptions& options : every_method()) {
    const Sample sample = random_sample(20);
    Problem problem = make_problem(sample, sample.handles.v);
    const Summary summary = solve(problem, options);
    EXPECT_EQ(summary.status, Status::kConverged) << name_of(options) << summary.message;
    EXPECT_LT((problem.x.X - sample.rest().X).cwiseAbs().maxCoeff(), 1e-9) << name_of(options);
  }
}

// At a minimum of 0 all that is left of F is rounding, which no step lowers: far from the origin
// there is more of it.
TEST(EveryMethod, ConvergesWhereFIsZeroUpToRounding) {
  const Eigen::Vector3d size(3, 1, 0.3), away(100, 70, 30);
  for (const SolverOptions& options : every_method()) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Sample sample = make_sample(random_points(30, size, seed).colwise() + away,
                                        random_points(450, size, seed + 1).colwise() + away, 4);
      Problem problem = make_problem(sample, sample.handles.v);
      const Summary summary = solve(problem, options);
      EXPECT_EQ(summary.status, Status::kConverged) << name_of(options) << summary.message;
      EXPECT_LT(summary.final_cost, 1e-18) << name_of(options);
    }
  }
}

TEST(EveryMethod, FillsTheSummary) {
  for (const SolverOptions& options : every_method()) {
    Problem problem = twisted_plate(20);
    const Unknowns start = problem.x;
    const double initial = cost(problem, start);
    const Summary s = solve(problem, options);
    EXPECT_NEAR(s.initial_cost, initial, 1e-12 * initial);
    EXPECT_NEAR(s.final_cost, cost(problem, problem.x), 1e-12 * initial);
    double sum = 0;
    for (const auto& [name, value] : s.cost_by_term) sum += value;
    EXPECT_NEAR(sum, s.final_cost, 1e-12 * initial);
    EXPECT_EQ(s.cost_by_term.size(), problem.terms.size());
    EXPECT_EQ(s.unknowns, 20 * 12);
    EXPECT_EQ(s.iterations.back().cost, s.final_cost) << name_of(options);
    const int linear_work = s.factorizations + s.cg_iterations;
    EXPECT_GE(linear_work, std::ssize(s.iterations)) << name_of(options);
    EXPECT_GT(s.seconds.at("total"), 0);
    EXPECT_THAT(s.blas, HasSubstr("openblas"));
    EXPECT_EQ(s.method, deformlab::name_of(options.method));
  }
}

TEST(EveryMethod, LeavesFixedNodesAloneToTheBit) {
  for (const SolverOptions& options : every_method()) {
    Problem problem = twisted_plate(20);
    problem.x = perturbed(problem.x, 0.01);
    problem.fixed[3] = problem.fixed[11] = 1;
    const Unknowns start = problem.x;
    const Summary summary = solve(problem, options);
    EXPECT_EQ(summary.unknowns, 18 * 12);
    for (const int j : {3, 11}) {
      EXPECT_EQ(problem.x.X.middleCols(4 * j, 4), start.X.middleCols(4 * j, 4)) << name_of(options);
    }
    EXPECT_NE(problem.x.X, start.X);
  }
}

TEST(EveryMethod, HasNothingToDoWhereAllNodesAreFixed) {
  for (const SolverOptions& options : every_method()) {
    Problem problem = twisted_plate(20);
    problem.fixed.assign(20, 1);
    const Unknowns start = problem.x;
    const Summary summary = solve(problem, options);
    EXPECT_EQ(summary.status, Status::kConverged) << name_of(options) << ": " << summary.message;
    EXPECT_EQ(problem.x.X, start.X) << name_of(options);
    EXPECT_NEAR(summary.final_cost, cost(problem, start), 1e-9) << name_of(options);
    EXPECT_EQ(summary.unknowns, 0) << name_of(options);
  }
}

TEST(EveryMethod, StaysWhereThereIsNoTerm) {
  for (const SolverOptions& options : every_method()) {
    Problem problem = twisted_plate(20);
    problem.terms.clear();
    const Unknowns start = problem.x;
    const Summary summary = solve(problem, options);
    EXPECT_EQ(summary.status, Status::kConverged) << name_of(options) << ": " << summary.message;
    EXPECT_EQ(problem.x.X, start.X) << name_of(options);
    EXPECT_EQ(summary.final_cost, 0);
  }
}

// Nothing says how far the plate turns about its only handle.
Problem held_at_one_point() {
  Sample sample = random_sample(20);
  sample.handles = subset(sample.handles, std::vector<int>{0});
  return make_problem(sample, sample.handles.v.colwise() + Eigen::Vector3d(0.5, 0.2, 1));
}

// Nodes on a line: nothing says how they turn about it.
Problem straight_chain() {
  Eigen::Matrix3Xd g = Eigen::Matrix3Xd::Zero(3, 12), v = Eigen::Matrix3Xd::Zero(3, 60);
  g.row(0).setLinSpaced(0, 11);
  v.row(0).setLinSpaced(0, 11);
  const Sample sample = make_sample(g, v, 2);
  return make_problem(sample, sample.handles.v.colwise() + Eigen::Vector3d(0, 0.3, 0.2));
}

TEST(SingularProblems, EndFiniteAndSaySo) {
  for (const SolverOptions& options : every_method()) {
    for (const bool chain : {false, true}) {
      Problem problem = chain ? straight_chain() : held_at_one_point();
      const Summary summary = solve(problem, options);
      EXPECT_TRUE(problem.x.X.allFinite());
      EXPECT_EQ(summary.status, Status::kConverged) << name_of(options) << summary.message;
      EXPECT_LT(summary.final_cost, 1e-6) << name_of(options);
      // Conjugate gradients solve a singular system that has solutions without noticing.
      const bool factors =
          options.method == SolverMethod::kGaussNewton && options.linear_solver != "kronecker_cg";
      if (factors && options.globalization != "levenberg") {
        ASSERT_EQ(summary.notes.size(), 1u) << name_of(options);
        EXPECT_THAT(summary.notes[0], HasSubstr("singular")) << name_of(options);
      }
    }
  }
}

TEST(EveryMethod, FailsWhereTheStartIsNotFiniteAndLeavesTheState) {
  for (const SolverOptions& options : every_method()) {
    Problem problem = twisted_plate(20);
    problem.x.X(0, 0) = 1e200;  // its square is infinite
    const Unknowns start = problem.x;
    const Summary summary = solve(problem, options);
    EXPECT_EQ(summary.status, Status::kFailed) << name_of(options);
    EXPECT_NE(summary.message, "") << name_of(options);
    EXPECT_EQ(problem.x.X, start.X) << name_of(options);
  }
}

TEST(EveryMethod, CanBeUsedAgainAfterAFailure) {
  for (const SolverOptions& options : every_method()) {
    Problem problem = twisted_plate(20);
    const Unknowns start = problem.x;
    const auto solver = make_solver(options);
    solver->compile(problem);
    problem.x.X(0, 0) = 1e200;
    solver->solve(problem);
    problem.x = start;
    EXPECT_EQ(solver->solve(problem).status, Status::kConverged) << name_of(options);
  }
}

TEST(EveryMethod, SaysWhenItRanOutOfIterations) {
  for (SolverOptions options : every_method()) {
    Problem problem = twisted_plate(20);
    options.max_iterations = 1;
    const Summary summary = solve(problem, options);
    EXPECT_EQ(summary.status, Status::kMaxIterations) << name_of(options);
    EXPECT_EQ(summary.iterations.size(), 1u) << name_of(options);
  }
}

TEST(EveryMethod, GivesTheSameBitsTwice) {
  for (const SolverOptions& options : every_method()) {
    Problem one = twisted_plate(30), two = twisted_plate(30);
    solve(one, options);
    solve(two, options);
    EXPECT_EQ(one.x.X, two.x.X) << name_of(options);
  }
}

}  // namespace
}  // namespace deformlab::test
