// A step and a whole solve of the reference scene, by both solvers.
#include <benchmark/benchmark.h>

#include "experiments/benchmarks/reference_scene.h"
#include "solvers/stopwatch.h"

namespace deformlab {
namespace {

SolverOptions by(SolverMethod method, const char* linear_solver) {
  SolverOptions options;
  options.method = method;
  options.linear_solver = linear_solver;
  return options;
}

void describe(benchmark::State& state, const Summary& solve) {
  state.SetComplexityN(state.range(0));
  state.counters["steps"] = static_cast<double>(solve.iterations.size());
  state.counters["cost"] = solve.final_cost;
  if (solve.status != Status::kConverged) state.SkipWithError(solve.message.c_str());
}

// The mean time of a step. Neither our compilation nor Ceres' preprocessing is in it.
void step(benchmark::State& state, SolverMethod method, const char* linear_solver) {
  auto deformation =
      reference_deformation(static_cast<int>(state.range(0)), by(method, linear_solver));
  deformation.compile(reference_scene().handles);
  Summary solve;
  for (auto _ : state) {
    deformation.reset();
    solve = deformation.update(reference_scene().targets).solve;
    state.SetIterationTime((solve.seconds["total"] - solve.seconds["preprocess"]) /
                           static_cast<double>(solve.iterations.size()));
  }
  describe(state, solve);
}

// The compilation and all steps from rest.
void whole_solve(benchmark::State& state, SolverMethod method, const char* linear_solver) {
  auto deformation =
      reference_deformation(static_cast<int>(state.range(0)), by(method, linear_solver));
  Summary solve;
  for (auto _ : state) {
    deformation.reset();
    double seconds = 0;
    {
      Stopwatch watch(seconds);
      deformation.compile(reference_scene().handles);
    }
    solve = deformation.update(reference_scene().targets).solve;
    state.SetIterationTime(seconds + solve.seconds["total"]);
  }
  describe(state, solve);
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int m : {100, 222, 425, 1048, 2048, 4000}) b->Arg(m);
  b->ArgName("nodes")->UseManualTime()->Unit(benchmark::kMillisecond)->Complexity();
  b->MinTime(0.05);  // short, because a whole solve is needed to measure one step
}

BENCHMARK_CAPTURE(step, gauss_newton, SolverMethod::kGaussNewton, "cholmod")->Apply(sizes);
BENCHMARK_CAPTURE(step, kronecker_cg, SolverMethod::kGaussNewton, "kronecker_cg")->Apply(sizes);
BENCHMARK_CAPTURE(step, ceres, SolverMethod::kCeres, "auto")->Apply(sizes);
BENCHMARK_CAPTURE(whole_solve, gauss_newton, SolverMethod::kGaussNewton, "cholmod")->Apply(sizes);
BENCHMARK_CAPTURE(whole_solve, kronecker_cg, SolverMethod::kGaussNewton, "kronecker_cg")
    ->Apply(sizes);
BENCHMARK_CAPTURE(whole_solve, ceres, SolverMethod::kCeres, "auto")->Apply(sizes);

}  // namespace
}  // namespace deformlab
