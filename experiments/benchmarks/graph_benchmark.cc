// Building a deformation graph for the 40,401 vertices of the reference scene.
#include <benchmark/benchmark.h>

#include "experiments/benchmarks/reference_scene.h"
#include "geometry/graph/placement/sampling.h"

namespace deformlab {
namespace {

const int kNeighbors = GraphOptions{}.neighbors;

void sample(benchmark::State& state) {
  const Shape& shape = reference_scene().shape;
  for (auto _ : state) {
    benchmark::DoNotOptimize(sample_nodes(shape, static_cast<int>(state.range(0)), 1));
  }
  state.SetComplexityN(state.range(0));
}

void embed_vertices(benchmark::State& state) {
  const Shape& shape = reference_scene().shape;
  const auto nodes = sample_nodes(shape, static_cast<int>(state.range(0)), 1);
  for (auto _ : state) benchmark::DoNotOptimize(embed(shape.V, nodes, kNeighbors));
  state.SetComplexityN(state.range(0));
  state.SetItemsProcessed(state.iterations() * shape.V.cols());
}

void connect_nodes(benchmark::State& state) {
  const Shape& shape = reference_scene().shape;
  const auto nodes = sample_nodes(shape, static_cast<int>(state.range(0)), 1);
  const Embedding embedding = embed(shape.V, nodes, kNeighbors);
  for (auto _ : state) benchmark::DoNotOptimize(connect(nodes, embedding));
  state.SetComplexityN(state.range(0));
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int m : {100, 425, 1048, 4000}) b->Arg(m);
  b->ArgName("nodes")->Unit(benchmark::kMillisecond)->MinTime(0.2)->Complexity();
}

BENCHMARK(sample)->Apply(sizes);
BENCHMARK(embed_vertices)->Apply(sizes);
BENCHMARK(connect_nodes)->Apply(sizes);

}  // namespace
}  // namespace deformlab
