#include <SuiteSparse_config.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>

#include "tests/support/heap_calls.h"
#include "tests/support/problems.h"

// Of the heap calls of the whole program CHOLMOD's own, which go through SuiteSparse's
// function pointers, are left out. (Eigen allocates by malloc, not by operator new.)
namespace {

struct InsideSuiteSparse {
  InsideSuiteSparse() { deformlab::test::heap_calls_are_counted = false; }
  ~InsideSuiteSparse() { deformlab::test::heap_calls_are_counted = true; }
};

void* suitesparse_malloc(size_t size) {
  const InsideSuiteSparse mark;
  return std::malloc(size);
}
void* suitesparse_calloc(size_t n, size_t size) {
  const InsideSuiteSparse mark;
  return std::calloc(n, size);
}
void* suitesparse_realloc(void* p, size_t size) {
  const InsideSuiteSparse mark;
  return std::realloc(p, size);
}

}  // namespace

namespace deformlab::test {
namespace {

class Allocations : public ::testing::Test {
 protected:
  void SetUp() override {
    SuiteSparse_config.malloc_func = suitesparse_malloc;
    SuiteSparse_config.calloc_func = suitesparse_calloc;
    SuiteSparse_config.realloc_func = suitesparse_realloc;
  }
  void TearDown() override {
    SuiteSparse_config.malloc_func = std::malloc;
    SuiteSparse_config.calloc_func = std::calloc;
    SuiteSparse_config.realloc_func = std::realloc;
  }

  // Of a solve of so many steps, after one that has warmed every workspace up.
  //   removed  how many handles are removed after the compilation
  static long in_a_solve(SolverOptions options, int steps, const LossOptions& loss = {},
                         int removed = 0) {
    const Sample sample = random_sample(100);
    Problem problem = make_problem(sample, twisted(sample.handles, 1.5, 3));
    term(problem, "constraint").loss = make_loss(loss);
    const Unknowns start = problem.x;
    options.max_iterations = steps;
    const auto solver = make_solver(options);
    solver->compile(problem);
    if (removed > 0) remove_handles(sample, removed, problem, *solver);
    solver->solve(problem);
    problem.x = start;
    const long before = heap_calls;
    const Summary summary = solver->solve(problem);
    const long result = heap_calls - before;
    EXPECT_EQ(std::ssize(summary.iterations), steps) << summary.message;
    return result;
  }

 private:
  static void remove_handles(Sample sample, int count, Problem& problem, Solver& solver) {
    std::vector<int> left(sample.handles.v.cols() - count);
    std::iota(left.begin(), left.end(), count);
    sample.handles = subset(sample.handles, left);
    Problem fewer = make_problem(sample, twisted(sample.handles, 1.5, 3));
    const std::size_t i = index_of_term(problem, "constraint");
    problem.terms[i].energy = std::move(fewer.terms[i].energy);
    EXPECT_TRUE(solver.change_elements(problem, i));
  }
};

TEST_F(Allocations, AreCounted) {
  const long before = heap_calls;
  const std::vector<double> numbers(100);
  EXPECT_GE(heap_calls - before, 1);
}

TEST_F(Allocations, AStepMakesNone) {
  for (const char* linear_solver : {"cholmod", "kronecker_cg"}) {
    for (const char* globalization : {"none", "line_search", "levenberg", "accelerated"}) {
      const SolverOptions options = gauss_newton(linear_solver, globalization, 1e-300);
      EXPECT_EQ(in_a_solve(options, 3), in_a_solve(options, 6))
          << linear_solver << " " << globalization;
      const LossOptions loss{LossKind::kHuber, 0.1};
      EXPECT_EQ(in_a_solve(options, 3, loss), in_a_solve(options, 6, loss))
          << linear_solver << " " << globalization << " with a loss";
    }
  }
}

TEST_F(Allocations, AStepAfterAChangeOfHandlesMakesNone) {
  const SolverOptions options = gauss_newton("kronecker_cg", "accelerated", 1e-300);
  EXPECT_EQ(in_a_solve(options, 3, {}, 5), in_a_solve(options, 6, {}, 5));
}

}  // namespace
}  // namespace deformlab::test
