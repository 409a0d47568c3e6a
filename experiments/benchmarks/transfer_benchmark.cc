// The transfer of a graph's transformations to a million vertices.
#include <benchmark/benchmark.h>

#include <cmath>

#include "experiments/benchmarks/reference_scene.h"
#include "geometry/graph/placement/sampling.h"

namespace deformlab {
namespace {

struct Million {
  Shape shape = bumpy_plane(1000);
  Eigen::Matrix3Xd nodes = sample_nodes(reference_scene().shape, 425, 1);
  Embedding embedding = embed(shape.V, nodes, GraphOptions{}.neighbors);
  Transformations X = rest_transformations(nodes.cols());

  Million() {  // moves the nodes from rest; every R_j stays invertible
    for (Eigen::Index i = 0; i < X.size(); ++i) X.data()[i] += 0.1 * std::sin(double(i));
  }
};

const Million& million() {
  static const Million data;
  return data;
}

void positions(benchmark::State& state) {
  const Million& data = million();
  for (auto _ : state) {
    benchmark::DoNotOptimize(transfer_positions(data.X, data.nodes, data.embedding));
  }
  state.SetItemsProcessed(state.iterations() * data.shape.V.cols());
}

void normals(benchmark::State& state) {
  const Million& data = million();
  for (auto _ : state) {
    benchmark::DoNotOptimize(transfer_normals(data.X, data.shape.N, data.embedding));
  }
  state.SetItemsProcessed(state.iterations() * data.shape.V.cols());
}

BENCHMARK(positions)->Name("transfer_positions/vertices:1000000")->Unit(benchmark::kMillisecond);
BENCHMARK(normals)->Name("transfer_normals/vertices:1000000")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deformlab
