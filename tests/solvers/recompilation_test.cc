#include <gtest/gtest.h>

#include "tests/support/problems.h"

namespace deformlab::test {
namespace {

// Compiles and solves a plate again and again, each time from where it ended, while handles, fixed
// nodes and the loss of the constraint change. The structure of A and of its preconditioner is
// another one each time. Sanitizers see what is written beyond its place.
void compile_in_all_orders(int m, const SolverOptions& options,
                           std::initializer_list<LossKind> losses) {
  Problem problem = twisted_plate(m);
  const std::vector<char> fixed = problem.fixed;
  const auto solver = make_solver(options);
  for (const LossKind kind : losses) {
    for (const bool more_fixed : {false, true}) {
      problem.fixed = fixed;
      for (int j = 0; more_fixed && j < m; j += 7) problem.fixed[j] = 1;
      term(problem, "constraint").loss = make_loss({kind, 0.5});
      solver->compile(problem);
      for (int i = 0; i < 2; ++i) {
        const Summary s = solver->solve(problem);
        EXPECT_TRUE(s.status == Status::kConverged || s.status == Status::kStalled)
            << m << " nodes, " << name_of(kind) << ": " << s.message;
        EXPECT_TRUE(problem.x.X.allFinite());
      }
    }
  }
}

constexpr auto kEveryLoss = {LossKind::kNone,   LossKind::kHuber, LossKind::kNone,
                             LossKind::kCauchy, LossKind::kTukey, LossKind::kNone};

TEST(Recompilation, OfKroneckerCgWithEveryLoss) {
  const SolverOptions options = gauss_newton("kronecker_cg", "accelerated");
  compile_in_all_orders(200, options, kEveryLoss);
  compile_in_all_orders(1000, options, kEveryLoss);
  compile_in_all_orders(4000, options, {LossKind::kNone, LossKind::kHuber});
}

TEST(Recompilation, OfCholmodWithEveryLoss) {
  compile_in_all_orders(200, gauss_newton("cholmod", "accelerated"), kEveryLoss);
}

TEST(Recompilation, OfAutoWithSomeLosses) {
  const auto losses = {LossKind::kCauchy, LossKind::kNone, LossKind::kTukey};
  compile_in_all_orders(2000, gauss_newton("auto", "levenberg"), losses);
}

}  // namespace
}  // namespace deformlab::test
