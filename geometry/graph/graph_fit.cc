#include "geometry/graph/graph_fit.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace deformlab {
namespace {

constexpr int kFewNodes = 50;
constexpr int kVerticesPerNode = 4;

std::vector<std::pair<int, int>> pairs_along(const WeldedSurface& surface,
                                             const Embedding& embedding) {
  const std::vector<int>& first = surface.first();
  std::vector<std::pair<int, int>> pairs;
  std::pair<int, int> last;
  for (const auto& face : surface.shape().faces) {
    for (std::size_t c = 0; c < face.size(); ++c) {
      const int one = embedding.nodes(0, first[face[c]]);
      const int other = embedding.nodes(0, first[face[(c + 1) % face.size()]]);
      const std::pair<int, int> pair = std::minmax(one, other);
      if (one == other || pair == last) continue;
      pairs.push_back(last = pair);
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// Entries of weight 0 that name a node that is left out get another node of the graph.
void renumber(const std::vector<int>& number, int count, Embedding& embedding) {
  const Eigen::Index k = std::min<Eigen::Index>(embedding.nodes.rows(), count);
  embedding.nodes.conservativeResize(k, Eigen::NoChange);
  embedding.weights.conservativeResize(k, Eigen::NoChange);
  for (auto nodes : embedding.nodes.colwise()) {
    for (int& j : nodes) j = number[j];
    int next = 0;
    for (int& j : nodes) {
      if (j >= 0) continue;
      while (std::ranges::find(nodes, next) != nodes.end()) ++next;
      j = next;
    }
  }
}

template <class Values>
Values kept(const Values& values, const std::vector<int>& indices) {
  Values result;
  for (const int j : indices) result.push_back(values[j]);
  return result;
}

}  // namespace

int fitting_nodes(const WeldedSurface& surface, int most) {
  const int places = surface.places();
  return std::min(most, std::max(std::min(places, kFewNodes), places / kVerticesPerNode));
}

bool join_along_surface(const WeldedSurface& surface, const Embedding& embedding,
                        DeformationGraph& graph) {
  double least = 1;
  for (const GraphEdge& edge : graph.edges) least = std::min(least, edge.alpha);
  const auto is_before = [](const GraphEdge& a, const GraphEdge& b) {
    return std::pair(a.j, a.k) < std::pair(b.j, b.k);
  };
  std::vector<GraphEdge> added;
  for (const auto& [j, k] : pairs_along(surface, embedding)) {
    const GraphEdge edge{j, k, least};
    if (!std::ranges::binary_search(graph.edges, edge, is_before)) added.push_back(edge);
  }
  graph.edges.insert(graph.edges.end(), added.begin(), added.end());
  std::ranges::sort(graph.edges, is_before);
  return !added.empty();
}

void leave_out_idle_nodes(BuiltGraph& built, Embedding& embedding) {
  const auto m = static_cast<std::size_t>(built.graph.g.cols());
  std::vector<int> number(m, -1), used;
  std::vector<char> followed(m, 0);
  for (Eigen::Index i = 0; i < embedding.nodes.cols(); ++i) {
    for (Eigen::Index a = 0; a < embedding.nodes.rows(); ++a) {
      if (embedding.weights(a, i) > 0) followed[embedding.nodes(a, i)] = 1;
    }
  }
  for (std::size_t j = 0; j < m; ++j) {
    if (!followed[j]) continue;
    number[j] = static_cast<int>(used.size());
    used.push_back(static_cast<int>(j));
  }
  if (used.size() == m) return;
  renumber(number, static_cast<int>(used.size()), embedding);
  built.graph.g = Eigen::Matrix3Xd(built.graph.g(Eigen::all, used));
  if (!built.node_vertices.empty()) built.node_vertices = kept(built.node_vertices, used);
  std::erase_if(built.graph.edges,
                [&](const GraphEdge& edge) { return number[edge.j] < 0 || number[edge.k] < 0; });
  for (GraphEdge& edge : built.graph.edges) edge.j = number[edge.j], edge.k = number[edge.k];
}

}  // namespace deformlab
