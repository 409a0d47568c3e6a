#include "deformers/embedded/animated_deformation.h"

#include <fmt/format.h>

#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "geometry/graph/graph_vertices.h"
#include "geometry/graph/sampling.h"

namespace deformlab {
namespace {

constexpr double kSame = 1e-6;  // a node this near to a vertex sits on it [diagonal of the shape]

EmbeddedDeformation on_vertices(const Shape& pose, EmbeddedDeformationOptions options) {
  refuse_interior(options.graph, "the nodes of an animation sit on vertices, to go with them");
  const GraphOptions& graph = options.graph;
  const bool between_vertices =
      graph.method == NodePlacement::kSampling && graph.distance == NodeDistance::kEuclidean;
  if (!between_vertices) return {pose, options};
  check_options(options);
  const std::vector<int> vertices = inside_option("graph", [&] {
    return distinct_nearest_vertices(sample_nodes(pose, graph.nodes, graph.seed), pose.V);
  });
  const Eigen::Matrix3Xd nodes = pose.V(Eigen::all, vertices);
  return {pose, nodes, options};
}

// The vertices at the nodes g (3×m), of which those that the graph knows are near to them.
std::vector<int> vertices_at(const Eigen::Matrix3Xd& g, const Eigen::Matrix3Xd& V,
                             const std::vector<int>& known) {
  std::vector<int> vertices = std::ssize(known) == g.cols() ? known : nearest_vertices(g, V);
  const double same = kSame * bounding_box_diagonal(V);
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    const double away = (g.col(j) - V.col(vertices[static_cast<std::size_t>(j)])).norm();
    if (away <= same) continue;
    throw InputError(fmt::format(
        "node {} of the graph is {:g} away from the nearest vertex, {}; the nodes of an animation "
        "sit on vertices, to go with them: put it there",
        j + 1, away, vertices[static_cast<std::size_t>(j)]));
  }
  return vertices;
}

}  // namespace

AnimatedDeformation::AnimatedDeformation(const Shape& pose,
                                         const EmbeddedDeformationOptions& options)
    : pose_(pose), deformation_(on_vertices(pose, options)) {
  find_node_vertices();
}

// The graph may depend on the handles.
void AnimatedDeformation::find_node_vertices() {
  node_vertices_ = vertices_at(deformation_.graph().g, pose_.V, deformation_.node_vertices());
}

void AnimatedDeformation::compile(const Handles& handles) {
  if (handles.points.cols() > 0) {
    throw InputError(
        "a point that is not a vertex does not follow an animation; use vertices as handles");
  }
  deformation_.repose(pose_, pose_.V(Eigen::all, node_vertices_));
  deformation_.compile(handles);
  find_node_vertices();
  handles_ = handles;
}

Report AnimatedDeformation::update(const Shape& frame, const Eigen::Matrix3Xd& offsets,
                                   const Eigen::Matrix3Xd& rotations) {
  check_targets(offsets, std::ssize(handles_.moved));
  handles_.rotations = rotations;
  deformation_.repose(frame, frame.V(Eigen::all, node_vertices_));
  deformation_.compile(handles_);
  return deformation_.update(frame.V(Eigen::all, handles_.moved) + offsets);
}

}  // namespace deformlab
