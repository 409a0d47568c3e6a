#include "geometry/graph/graph_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <utility>

#include "geometry/graph/active_part.h"
#include "geometry/graph/graph_file.h"
#include "geometry/graph/graph_fit.h"
#include "geometry/graph/graph_vertices.h"
#include "geometry/graph/placement/graph_grid.h"
#include "geometry/graph/placement/graph_simplification.h"
#include "geometry/graph/placement/sampling.h"
#include "geometry/transfer/geodesic.h"

namespace deformlab {
namespace {

template <class Action>
auto timed(double& seconds, Action&& action) {
  const auto start = std::chrono::steady_clock::now();
  auto result = action();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

// Nodes, the vertices that they sit on (if any), and the edges that a file gives (if it does).
struct Placed {
  Eigen::Matrix3Xd g;
  std::vector<int> vertices{};
  std::optional<std::vector<GraphEdge>> edges{};
};

void check_file(const GraphOptions& options) {
  const bool by_hand = options.method == NodePlacement::kFile;
  if (by_hand && options.file.empty()) {
    throw OptionError("method", "file",
                      ", but the option file names none; give it an OBJ file of 'v x y z' and "
                      "'l i j' lines");
  }
  if (!by_hand && !options.file.empty()) {
    throw OptionError("file", fmt::format("'{}'", options.file.string()),
                      fmt::format(", but method is {}; make it file, or leave the file out",
                                  name_of(options.method)));
  }
}

Placed place(const WeldedSurface& surface, const GraphOptions& options) {
  const Shape& shape = surface.shape();
  const int m = options.fit ? fitting_nodes(surface, options.nodes) : options.nodes;
  const auto at = [&](const std::vector<int>& vertices) {
    return Placed{shape.V(Eigen::all, vertices), vertices};
  };
  switch (options.method) {
    case NodePlacement::kSampling:
      break;
    case NodePlacement::kSimplification:
      return at(simplify(shape, m, options.aspect_ratio).vertices);
    case NodePlacement::kGrid:
      return at(grid_nodes(shape, m));
    case NodePlacement::kFile: {
      DeformationGraph graph = read_graph(options.file);
      return {std::move(graph.g), {}, std::move(graph.edges)};
    }
  }
  const Eigen::Matrix3Xd g = sample_nodes(shape, m, options.seed, options.fit);
  if (options.distance == NodeDistance::kEuclidean) return {g};
  return at(distinct_nearest_vertices(g, shape.V));
}

bool is_before(const GraphEdge& one, const GraphEdge& other) {
  return std::pair(one.j, one.k) < std::pair(other.j, other.k);
}

// Gives the edges of a file the weights of the same edges by influence, or 0 where there is none.
std::vector<GraphEdge> weighed(std::vector<GraphEdge> by_hand,
                               const std::vector<GraphEdge>& by_influence) {
  for (GraphEdge& edge : by_hand) {
    const auto same = std::lower_bound(by_influence.begin(), by_influence.end(), edge, is_before);
    edge.alpha = same != by_influence.end() && !is_before(edge, *same) ? same->alpha : 0;
  }
  return by_hand;
}

class Builder {
 public:
  Builder(const WeldedSurface& surface, const GraphOptions& options, std::span<const Cut> cuts)
      : surface_(surface), shape_(surface.shape()), options_(options), cuts_(cuts) {}

  BuiltGraph run(const Placed& placed) {
    VertexEmbedding embedded = timed(built_.seconds["embed"], [&] { return embed(placed); });
    built_.in_space = embedded.followed.empty();
    built_.graph = timed(built_.seconds["connect"], [&] { return join(placed, embedded); });
    if (options_.fit && !placed.edges) leave_out_idle_nodes(built_, embedded.embedding);
    note(embedded);
    built_.embedding = std::move(embedded.embedding);
    return std::move(built_);
  }

 private:
  VertexEmbedding embed(const Placed& placed) {
    built_.node_vertices = placed.vertices;
    const bool needed = !cuts_.empty() || options_.distance != NodeDistance::kEuclidean;
    if (needed && placed.vertices.empty()) {
      built_.node_vertices = nearest_vertices(placed.g, shape_.V);
    }
    groups_ = group(shape_.V.cols(), built_.node_vertices, cuts_);
    return embed_vertices(surface_, placed.g, built_.node_vertices, groups_, options_);
  }

  DeformationGraph join(const Placed& placed, const VertexEmbedding& embedded) {
    DeformationGraph graph =
        connect(placed.g, embedded.embedding, options_.alpha, embedded.followed);
    if (placed.edges) take(*placed.edges, graph);
    const bool joined =
        options_.fit && !placed.edges && join_along_surface(surface_, embedded.embedding, graph);
    if (!cuts_.empty()) cut(graph);
    if (joined && options_.alpha == EdgeWeights::kLength) weigh_by_length(graph);
    const bool changed = placed.edges || !cuts_.empty() || joined;
    if (changed && options_.alpha != EdgeWeights::kUniform) normalize_weights(graph);
    return graph;
  }

  // Edges of weight 0 are removed, so that a part that only they join counts as a part of its own.
  void take(const std::vector<GraphEdge>& by_hand, DeformationGraph& graph) {
    const bool by_overlap = options_.alpha == EdgeWeights::kOverlap;
    graph.edges = by_overlap ? weighed(by_hand, graph.edges) : by_hand;
    if (options_.alpha == EdgeWeights::kLength) weigh_by_length(graph);
    const auto left_out =
        std::erase_if(graph.edges, [](const GraphEdge& edge) { return edge.alpha == 0; });
    if (left_out == 0) return;
    built_.notes.push_back(fmt::format(
        "alpha: overlap leaves out edges that join nodes without a common vertex: {}", left_out));
  }

  void cut(DeformationGraph& graph) {
    const int before = parts_without_cuts(graph.g);
    std::erase_if(graph.edges, [&](const GraphEdge& edge) {
      return groups_.apart[groups_.of_node[edge.j]][groups_.of_node[edge.k]];
    });
    if (parts(graph) <= before) return;
    built_.notes.push_back(
        fmt::format("the cuts leave the graph in {} parts instead of {}: each "
                    "moves only with handles of its own",
                    parts(graph), before));
  }

  int parts_without_cuts(const Eigen::Matrix3Xd& g) const {
    if (options_.distance == NodeDistance::kEuclidean) {
      return parts(connect(g, deformlab::embed(shape_.V, g, options_.neighbors)));
    }
    const std::vector<int> part = connected_parts(shape_);
    std::set<int> met;
    for (const int v : built_.node_vertices) met.insert(part[v]);
    return static_cast<int>(met.size());
  }

  static int parts(const DeformationGraph& graph) {
    return 1 + std::ranges::max(components(graph));
  }

  void note(const VertexEmbedding& embedded) {
    const Eigen::Index m = built_.graph.g.cols(), k = embedded.embedding.nodes.rows();
    if (k < options_.neighbors) {
      built_.notes.push_back(fmt::format(
          "the graph has {} nodes, fewer than neighbors + 1: each vertex follows {}", m, k));
    }
    if (m > shape_.V.cols()) {
      built_.notes.push_back(
          fmt::format("the graph has {} nodes for {} vertices: nodes that no "
                      "vertex follows do nothing; use fewer",
                      m, shape_.V.cols()));
    }
    if (embedded.unreached > 0) {
      built_.notes.push_back(
          fmt::format("vertices on parts of the surface where no node is follow the nodes that are "
                      "nearest in space: {}; use more nodes",
                      embedded.unreached));
    }
  }

  const WeldedSurface& surface_;
  const Shape& shape_;
  const GraphOptions& options_;
  std::span<const Cut> cuts_;
  CutGroups groups_;
  BuiltGraph built_;
};

BuiltGraph build_whole(const Shape& shape, const GraphOptions& options, std::span<const Cut> cuts) {
  const WeldedSurface surface(shape);
  double seconds = 0;
  const Placed placed = timed(seconds, [&] { return place(surface, options); });
  BuiltGraph built = Builder(surface, options, cuts).run(placed);
  built.seconds["sample"] = seconds;
  return built;
}

BuiltGraph build_active(const Shape& shape, const ActivePart& part, const GraphOptions& options,
                        std::span<const Cut> cuts) {
  BuiltGraph built = build_whole(part.shape, options, cuts_of(part, cuts, shape.V.cols()));
  built.embedding = embedding_of_whole(part, built.embedding, shape.V);
  for (int& i : built.node_vertices) i = part.vertices[i];
  built.active = part.vertices;
  return built;
}

}  // namespace

BuiltGraph build_graph(const Shape& shape, const GraphOptions& options, std::span<const Cut> cuts,
                       std::span<const int> fixed) {
  check_options(options);
  check_file(options);
  check(shape, "the shape");
  if (options.region == NodeRegion::kWhole || fixed.empty()) {
    return build_whole(shape, options, cuts);
  }
  const ActivePart part = active_part(shape, fixed, options.nodes);
  if (part.is_whole(shape)) return build_whole(shape, options, cuts);
  return build_active(shape, part, options, cuts);
}

BuiltGraph build_graph(const Shape& shape, const Eigen::Matrix3Xd& nodes,
                       const GraphOptions& options, std::span<const Cut> cuts) {
  check_options(options);
  check(shape, "the shape");
  if (nodes.cols() > 0) check(Shape{nodes, {}, {}}, "the nodes");
  return Builder(WeldedSurface(shape), options, cuts).run({nodes});
}

BuiltGraph build_graph(const Shape& shape, DeformationGraph graph, const GraphOptions& options,
                       std::span<const Cut> cuts) {
  check_options(options);
  check(shape, "the shape");
  check(graph);
  return Builder(WeldedSurface(shape), options, cuts)
      .run({std::move(graph.g), {}, std::move(graph.edges)});
}

}  // namespace deformlab
