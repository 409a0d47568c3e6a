#include "geometry/graph/deformation_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "geometry/core/disjoint_sets.h"
#include "geometry/core/error.h"
#include "geometry/core/hash.h"

namespace deformlab {
namespace {

struct Overlap {
  int j, k;
  double amount;
  bool operator<(const Overlap& o) const { return std::pair(j, k) < std::pair(o.j, o.k); }
};

// Sums the overlap of each pair of nodes. A hash table with open addressing finds a pair in a time
// that does not grow with the number of points that the pair shares.
class Overlaps {
 public:
  void add(int j, int k, double amount) {
    if (kSlots * pairs_.size() >= table_.size()) grow();
    int& at = slot(j, k);
    if (at < 0) {
      at = static_cast<int>(pairs_.size());
      pairs_.push_back({j, k, 0});
    }
    pairs_[at].amount += amount;
  }
  std::vector<Overlap> sorted() && {
    std::sort(pairs_.begin(), pairs_.end());
    return std::move(pairs_);
  }

 private:
  static constexpr std::size_t kSlots = 8;  // per pair at least, so that most are found at once

  int& slot(int j, int k) {
    const std::size_t mask = table_.size() - 1;
    const std::uint64_t pair = std::uint64_t(std::uint32_t(j)) << 32 | std::uint32_t(k);
    std::size_t at = mixed(0, pair) & mask;
    while (table_[at] >= 0 && (pairs_[table_[at]].j != j || pairs_[table_[at]].k != k)) {
      at = (at + 1) & mask;
    }
    return table_[at];
  }
  void grow() {
    table_.assign(std::max<std::size_t>(1024, 2 * table_.size()), -1);
    for (int i = 0; i < static_cast<int>(pairs_.size()); ++i) slot(pairs_[i].j, pairs_[i].k) = i;
  }

  std::vector<int> table_;  // indices of pairs
  std::vector<Overlap> pairs_;
};

// The overlaps of all pairs of nodes that share a vertex.
std::vector<Overlap> overlaps(const Embedding& e, std::span<const int> followed) {
  Overlaps pairs;
  for (Eigen::Index i = 0; i < e.nodes.cols(); ++i) {
    const Eigen::Index k = followed.empty() ? e.nodes.rows() : followed[i];
    for (Eigen::Index a = 0; a < k; ++a) {
      for (Eigen::Index b = a + 1; b < k; ++b) {
        const int one = e.nodes(a, i), other = e.nodes(b, i);
        pairs.add(std::min(one, other), std::max(one, other), e.weights(a, i) * e.weights(b, i));
      }
    }
  }
  return std::move(pairs).sorted();
}

void check_edges(const DeformationGraph& graph) {
  const Eigen::Index m = graph.g.cols();
  for (const GraphEdge& e : graph.edges) {
    if (e.j >= 0 && e.j < m && e.k >= 0 && e.k < m && e.j != e.k) continue;
    throw InputError(fmt::format(
        "an edge of the graph joins the nodes {} and {} (counted from 0); the graph has {} nodes, "
        "and an edge joins two different ones",
        e.j, e.k, m));
  }
}

}  // namespace

void check(const DeformationGraph& graph) {
  check_edges(graph);
  for (Eigen::Index j = 0; j < graph.g.cols(); ++j) {
    if (graph.g.col(j).allFinite()) continue;
    throw InputError(
        fmt::format("node {} of the graph (counted from 0) is at ({:g}, {:g}, {:g}); "
                    "every number must be finite",
                    j, graph.g(0, j), graph.g(1, j), graph.g(2, j)));
  }
  for (const GraphEdge& e : graph.edges) {
    if (e.alpha >= 0 && std::isfinite(e.alpha)) continue;
    throw InputError(
        fmt::format("the edge between the nodes {} and {} has the weight {:g}; it has to be finite "
                    "and 0 or more",
                    e.j, e.k, e.alpha));
  }
}

DeformationGraph connect(const Eigen::Matrix3Xd& g, const Embedding& embedding, EdgeWeights alpha,
                         std::span<const int> followed) {
  check(embedding, g.cols());
  if (!followed.empty() && std::ssize(followed) != embedding.v.cols()) {
    throw InputError(fmt::format("there are {} numbers of nodes that count for {} points",
                                 followed.size(), embedding.v.cols()));
  }
  DeformationGraph graph{g, {}};
  for (const Overlap& o : overlaps(embedding, followed))
    graph.edges.push_back({o.j, o.k, o.amount});
  switch (alpha) {
    case EdgeWeights::kUniform:
      for (GraphEdge& edge : graph.edges) edge.alpha = 1;
      break;
    case EdgeWeights::kOverlap:
      normalize_weights(graph);
      break;
    case EdgeWeights::kLength:
      weigh_by_length(graph);
      break;
  }
  return graph;
}

void weigh_by_length(DeformationGraph& graph) {
  check_edges(graph);
  const auto length = [&](const GraphEdge& e) {
    return (graph.g.col(e.j) - graph.g.col(e.k)).norm();
  };
  double least = std::numeric_limits<double>::infinity();
  for (const GraphEdge& edge : graph.edges) {
    if (length(edge) > 0) least = std::min(least, length(edge));
  }
  // Lengths are divided by the shortest, so that no power overflows.
  for (GraphEdge& edge : graph.edges)
    edge.alpha = std::pow(std::max(1.0, length(edge) / least), -2);
  normalize_weights(graph);
}

void normalize_weights(DeformationGraph& graph) {
  double sum = 0;
  for (const GraphEdge& edge : graph.edges) sum += edge.alpha;
  for (GraphEdge& edge : graph.edges) {
    edge.alpha = sum > 0 ? edge.alpha * graph.edges.size() / sum : 1;
  }
}

double mean_edge_length(const DeformationGraph& graph) {
  check_edges(graph);
  double sum = 0;
  for (const GraphEdge& e : graph.edges) sum += (graph.g.col(e.j) - graph.g.col(e.k)).norm();
  const double fallback = graph.g.cols() > 0 ? bounding_box_diagonal(graph.g) : 0;
  const double mean = graph.edges.empty() ? fallback : sum / graph.edges.size();
  return mean > 0 ? mean : 1;
}

std::vector<int> components(const DeformationGraph& graph) {
  check_edges(graph);
  DisjointSets sets(graph.g.cols());
  for (const GraphEdge& edge : graph.edges) sets.join(edge.j, edge.k);
  return sets.numbered();
}

}  // namespace deformlab
