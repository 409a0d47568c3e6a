#include "deformers/embedded/animated_deformation.h"

#include <fmt/format.h>

#include <limits>
#include <map>

#include "deformers/embedded/handles/handle_groups.h"
#include "deformers/embedded/handles/line_turn.h"
#include "deformers/handle_checks.h"
#include "geometry/core/error.h"
#include "geometry/graph/graph_vertices.h"
#include "geometry/graph/placement/sampling.h"

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
  find_lines();
}

// The handles of each component of the graph in which nothing is fixed, if they are nearly on a
// line. The pose decides for all frames.
void AnimatedDeformation::find_lines() {
  lines_.clear();
  const std::vector<int> component = components(deformation_.graph());
  const Eigen::MatrixXi& nodes = deformation_.embedding().nodes;
  std::map<int, std::vector<int>> handles_of;
  for (std::size_t l = 0; l < handles_.moved.size(); ++l) {
    handles_of[component[nodes(0, handles_.moved[l])]].push_back(static_cast<int>(l));
  }
  for (const int i : handles_.fixed) handles_of.erase(component[nodes(0, i)]);
  const Eigen::Matrix3Xd rest = pose_.V(Eigen::all, handles_.moved);
  for (const auto& [number, handles] : handles_of) {
    const bool is_line = handles.size() > 1 && !spans_a_plane(rest(Eigen::all, handles), kNearLine);
    if (is_line) lines_.push_back(handles);
  }
}

// The rotations of a frame, in which handles on a line that nothing is said about turn with it.
Eigen::Matrix3Xd AnimatedDeformation::with_lines(const Eigen::Matrix3Xd& rotations,
                                                 const Eigen::Matrix3Xd& rest,
                                                 const Eigen::Matrix3Xd& targets) const {
  if (lines_.empty()) return rotations;
  Eigen::Matrix3Xd result = rotations;
  if (result.cols() == 0) {
    result.setConstant(3, rest.cols(), std::numeric_limits<double>::quiet_NaN());
  }
  for (const std::vector<int>& line : lines_) {
    const auto turn = shortest_turn(rest(Eigen::all, line), targets(Eigen::all, line));
    for (const int l : line) {
      if (turn && result.col(l).hasNaN()) result.col(l) = *turn;
    }
  }
  return result;
}

Report AnimatedDeformation::update(const Shape& frame, const Eigen::Matrix3Xd& offsets,
                                   const Eigen::Matrix3Xd& rotations) {
  check_targets(offsets, std::ssize(handles_.moved));
  if (frame.V.cols() != pose_.V.cols()) {
    throw InputError(fmt::format("a frame of {} vertices does not fit a pose of {} vertices",
                                 frame.V.cols(), pose_.V.cols()));
  }
  const Eigen::Matrix3Xd rest = frame.V(Eigen::all, handles_.moved), targets = rest + offsets;
  handles_.rotations = with_lines(rotations, rest, targets);
  deformation_.repose(frame, frame.V(Eigen::all, node_vertices_));
  deformation_.compile(handles_);
  return deformation_.update(targets);
}

}  // namespace deformlab
