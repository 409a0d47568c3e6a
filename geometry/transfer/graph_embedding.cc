#include "geometry/transfer/graph_embedding.h"

#include <algorithm>

#include "geometry/graph/graph_vertices.h"
#include "geometry/transfer/geodesic.h"
#include "geometry/transfer/path_aware.h"

namespace deformlab {
namespace {

// Embeds the vertices of one group over the nodes that they may follow.
class GroupEmbedding {
 public:
  GroupEmbedding(const Shape& shape, const Eigen::Matrix3Xd& g, const std::vector<int>& nodes,
                 std::vector<int> vertices, VertexEmbedding& result)
      : shape_(shape),
        g_(g(Eigen::all, nodes)),
        nodes_(nodes),
        vertices_(std::move(vertices)),
        result_(result),
        k_(static_cast<int>(result.embedding.nodes.rows())) {}

  void in_space() { in_space(vertices_); }

  // Takes the distances of all vertices to the nodes of the group.
  void along_surface(const NearestSources& nearest) {
    std::vector<int> unreached;
    for (const int i : vertices_) {
      if (nearest.found[i] == 0) {
        unreached.push_back(i);
      } else {
        along_surface(nearest, i);
      }
    }
    result_.unreached += static_cast<int>(unreached.size());
    in_space(unreached);
  }

 private:
  void in_space(const std::vector<int>& vertices) {
    if (vertices.empty()) return;
    const Embedding e = embed(shape_.V(Eigen::all, vertices), g_, k_);
    for (std::size_t c = 0; c < vertices.size(); ++c) {
      store(vertices[c], e.nodes.col(static_cast<Eigen::Index>(c)),
            e.weights.col(static_cast<Eigen::Index>(c)));
    }
  }

  // As in `embed`, with fewer than k+1 nodes the farthest gives d_max, and a single node has
  // weight 1.
  void along_surface(const NearestSources& nearest, int i) {
    const int k = std::min(k_, std::max(1, nearest.found[i] - 1));
    Eigen::VectorXd weights = nearest.distances.col(i).head(k + 1);
    if (nearest.found[i] == 1) weights << 0, 1;
    weigh(weights, k);
    store(i, nearest.sources.col(i).head(k), weights.head(k));
  }

  // Fills the rest of the column with the nodes nearest in space that are not in it yet.
  void store(int i, const Eigen::VectorXi& local, const Eigen::VectorXd& weights) {
    auto nodes = result_.embedding.nodes.col(i);
    const Eigen::VectorXi nearest = nodes;  // k nodes, of which at least k − #local are new
    result_.embedding.weights.col(i).setZero();
    result_.embedding.weights.col(i).head(weights.size()) = weights;
    Eigen::Index count = 0;
    for (const int j : local) nodes[count++] = nodes_[j];
    for (Eigen::Index a = 0; count < k_; ++a) {
      const auto end = nodes.begin() + count;
      if (std::find(nodes.begin(), end, nearest[a]) == end) nodes[count++] = nearest[a];
    }
    result_.followed[i] = static_cast<int>(local.size());
  }

  const Shape& shape_;
  const Eigen::Matrix3Xd g_;
  const std::vector<int>& nodes_;
  const std::vector<int> vertices_;
  VertexEmbedding& result_;
  const int k_;
};

std::vector<int> members(const std::vector<int>& of_vertex, std::size_t group) {
  std::vector<int> result;
  for (std::size_t i = 0; i < of_vertex.size(); ++i) {
    if (of_vertex[i] == static_cast<int>(group)) result.push_back(static_cast<int>(i));
  }
  return result;
}

// The embedding by distances that are known for as many nodes at every vertex. With fewer than k+1
// nodes the farthest gives d_max, and a single node has weight 1, as in `embed`.
VertexEmbedding embed_by(const NearestSources& nearest, const Eigen::Matrix3Xd& V) {
  const Eigen::Index found =
      std::min<Eigen::Index>(nearest.found.minCoeff(), nearest.sources.rows());
  const Eigen::Index k = std::max<Eigen::Index>(1, found - 1), n = V.cols();
  Embedding e{V, nearest.sources.topRows(k), Eigen::MatrixXd(k, n)};
  Eigen::VectorXd distances(k + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    distances = nearest.distances.col(i).head(k + 1);
    if (found == 1) distances << 0, 1;
    weigh(distances, static_cast<int>(k));
    e.weights.col(i) = distances.head(k);
  }
  return {std::move(e), std::vector<int>(static_cast<std::size_t>(n), static_cast<int>(k))};
}

NearestSources nearest_sources(const WeldedSurface& surface, std::span<const int> sources,
                               int count, NodeDistance distance) {
  if (distance == NodeDistance::kPathAware) return nearest_path_aware(surface, sources, count);
  const bool by_heat = distance == NodeDistance::kGeodesic;
  return (by_heat ? nearest_along_surface : nearest_along_edges)(surface.shape(), sources, count);
}

}  // namespace

VertexEmbedding embed_vertices(const WeldedSurface& surface, const Eigen::Matrix3Xd& g,
                               std::span<const int> node_vertices, const CutGroups& groups,
                               const GraphOptions& options) {
  const Shape& shape = surface.shape();
  const bool in_space = options.distance == NodeDistance::kEuclidean ||
                        (options.distance == NodeDistance::kPathAware && shape.faces.empty());
  const bool whole = groups.nodes.size() == 1;
  if (in_space && whole) return {embed(shape.V, g, options.neighbors), {}};
  if (options.distance == NodeDistance::kPathAware && whole) {
    return embed_by(nearest_path_aware(surface, node_vertices, options.neighbors + 1), shape.V);
  }
  VertexEmbedding result{embed(shape.V, g, options.neighbors), {}};
  result.followed.assign(static_cast<std::size_t>(shape.V.cols()), 0);
  for (std::size_t group = 0; group < groups.nodes.size(); ++group) {
    const std::vector<int>& nodes = groups.nodes[group];
    GroupEmbedding of_group(shape, g, nodes, members(groups.of_vertex, group), result);
    if (in_space) {
      of_group.in_space();
      continue;
    }
    std::vector<int> sources;
    for (const int j : nodes) sources.push_back(node_vertices[j]);
    of_group.along_surface(
        nearest_sources(surface, sources, options.neighbors + 1, options.distance));
  }
  return result;
}

Embedding embed_at_vertices(const Eigen::Matrix3Xd& points, const Embedding& vertices) {
  Embedding result = subset(vertices, nearest_vertices(points, vertices.v));
  result.v = points;
  return result;
}

}  // namespace deformlab
