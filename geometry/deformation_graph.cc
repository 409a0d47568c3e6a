#include "geometry/deformation_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/error.h"

namespace deformlab {
namespace {

struct Overlap {
  int j, k;
  double amount;
  bool operator<(const Overlap& o) const { return std::pair(j, k) < std::pair(o.j, o.k); }
};

// Every pair of nodes that share a vertex, once for each such vertex.
std::vector<Overlap> overlaps(const Embedding& e, std::span<const int> followed) {
  std::vector<Overlap> pairs;
  for (Eigen::Index i = 0; i < e.nodes.cols(); ++i) {
    const Eigen::Index k = followed.empty() ? e.nodes.rows() : followed[i];
    for (Eigen::Index a = 0; a < k; ++a) {
      for (Eigen::Index b = a + 1; b < k; ++b) {
        const auto [lo, hi] = std::minmax({e.nodes(a, i), e.nodes(b, i)});
        pairs.push_back({lo, hi, e.weights(a, i) * e.weights(b, i)});
      }
    }
  }
  std::stable_sort(pairs.begin(), pairs.end());  // stable: the sums below keep their order
  return pairs;
}

void normalize(std::vector<GraphEdge>& edges) {
  double sum = 0;
  for (const GraphEdge& edge : edges) sum += edge.alpha;
  for (GraphEdge& edge : edges) edge.alpha = sum > 0 ? edge.alpha * edges.size() / sum : 1;
}

int find_root(std::vector<int>& parent, int j) {
  while (parent[j] != j) j = parent[j] = parent[parent[j]];
  return j;
}

}  // namespace

DeformationGraph connect(const Eigen::Matrix3Xd& g, const Embedding& embedding,
                         const std::string& alpha, std::span<const int> followed) {
  if (alpha != "uniform" && alpha != "overlap") {
    throw InputError("unknown graph.alpha '" + alpha + "'; known: uniform, overlap");
  }
  DeformationGraph graph{g, {}};
  for (const Overlap& o : overlaps(embedding, followed)) {
    if (graph.edges.empty() || graph.edges.back().j != o.j || graph.edges.back().k != o.k) {
      graph.edges.push_back({o.j, o.k, 0});
    }
    graph.edges.back().alpha += o.amount;
  }
  if (alpha == "uniform") {
    for (GraphEdge& edge : graph.edges) edge.alpha = 1;
  } else {
    normalize(graph.edges);
  }
  return graph;
}

double mean_edge_length(const DeformationGraph& graph) {
  double sum = 0;
  for (const GraphEdge& e : graph.edges) sum += (graph.g.col(e.j) - graph.g.col(e.k)).norm();
  const double fallback = graph.g.cols() > 0 ? bounding_box_diagonal(graph.g) : 0;
  const double mean = graph.edges.empty() ? fallback : sum / graph.edges.size();
  return mean > 0 ? mean : 1;
}

std::vector<int> components(const DeformationGraph& graph) {
  std::vector<int> parent(graph.g.cols());
  std::iota(parent.begin(), parent.end(), 0);
  for (const GraphEdge& e : graph.edges) {
    const auto [lo, hi] = std::minmax({find_root(parent, e.j), find_root(parent, e.k)});
    parent[hi] = lo;  // the root is the smallest index, so numbers come out in order
  }
  std::vector<int> component(parent.size());
  int count = 0;
  for (int j = 0; j < static_cast<int>(parent.size()); ++j) {
    const int root = find_root(parent, j);
    component[j] = root == j ? count++ : component[root];
  }
  return component;
}

}  // namespace deformlab
