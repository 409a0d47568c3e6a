#include "deformers/embedded/animated_deformation.h"

#include <sstream>
#include <string>

#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "geometry/graph/graph_vertices.h"
#include "geometry/graph/sampling.h"

namespace deformlab {
namespace {

constexpr double kSame = 1e-6;  // of the diagonal: a node so far from a vertex still sits on it

EmbeddedDeformation on_vertices(const Shape& pose, const EmbeddedDeformationOptions& options) {
  const GraphOptions& graph = options.graph;
  const bool beside = graph.method == "sampling" && graph.distance == "euclidean";
  if (!beside) return {pose, options};
  const Eigen::Matrix3Xd sampled = sample_nodes(pose, graph.nodes, graph.seed);
  const Eigen::Matrix3Xd nodes = pose.V(Eigen::all, distinct_nearest_vertices(sampled, pose.V));
  return {pose, nodes, options};
}

std::vector<int> vertices_below(const Eigen::Matrix3Xd& g, const Eigen::Matrix3Xd& V) {
  const std::vector<int> vertices = nearest_vertices(g, V);
  const double same = kSame * bounding_box_diagonal(V);
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    const double away = (g.col(j) - V.col(vertices[static_cast<std::size_t>(j)])).norm();
    if (away <= same) continue;
    std::ostringstream message;
    message << "node " << j + 1 << " of the graph is " << away << " away from the nearest vertex, "
            << vertices[static_cast<std::size_t>(j)]
            << "; the nodes of an animation sit on vertices, to go with them: put it there";
    throw InputError(message.str());
  }
  return vertices;
}

}  // namespace

AnimatedDeformation::AnimatedDeformation(const Shape& pose,
                                         const EmbeddedDeformationOptions& options)
    : deformation_(on_vertices(pose, options)),
      node_vertices_(deformation_.graph().g.cols() == std::ssize(deformation_.node_vertices())
                         ? deformation_.node_vertices()
                         : vertices_below(deformation_.graph().g, pose.V)) {}

void AnimatedDeformation::compile(const Handles& handles) {
  if (handles.points.cols() > 0) {
    throw InputError("a place that is no vertex does not follow an animation; hold vertices");
  }
  deformation_.compile(handles);
  handles_ = handles;
}

Report AnimatedDeformation::update(const Shape& frame, const Eigen::Matrix3Xd& offsets) {
  check_targets(offsets, std::ssize(handles_.moved));
  deformation_.repose(frame, frame.V(Eigen::all, node_vertices_));
  deformation_.compile(handles_);
  return deformation_.update(frame.V(Eigen::all, handles_.moved) + offsets);
}

}  // namespace deformlab
