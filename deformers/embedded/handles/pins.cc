#include "deformers/embedded/handles/pins.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>

#include "deformers/embedded/handles/handle_groups.h"
#include "deformers/embedded/handles/line_turn.h"

namespace deformlab {
namespace {

constexpr int kMostNamed = 5;        // components that the notes name; others are only counted
constexpr double kSamePoint = 1e-6;  // relative to the shape's extent

struct Component {
  std::vector<int> nodes;
  std::vector<int> handles;
  bool has_fixed_node = false;
};

std::vector<Component> find_components(const DeformationGraph& graph, const Embedding& handles,
                                       const std::vector<char>& fixed) {
  std::vector<Component> result;
  const std::vector<int> component = components(graph);
  for (std::size_t j = 0; j < component.size(); ++j) {
    result.resize(std::max<std::size_t>(result.size(), component[j] + 1));
    result[component[j]].nodes.push_back(static_cast<int>(j));
    result[component[j]].has_fixed_node |= fixed[j] != 0;
  }
  // In a graph that was made by hand or cut, one handle may follow nodes of several components.
  for (int l = 0; l < handles.v.cols(); ++l) {
    for (Eigen::Index a = 0; a < handles.nodes.rows(); ++a) {
      std::vector<int>& known = result[component[handles.nodes(a, l)]].handles;
      const bool is_new = known.empty() || known.back() != l;
      if (is_new && handles.weights(a, l) > 0) known.push_back(l);
    }
  }
  return result;
}

// The dimension that the points span: 0 at one point, 1 on a line, 2 in a plane, 3 in space.
int affine_rank(const Eigen::Matrix3Xd& points, double extent) {
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::Matrix3d covariance = centred * centred.transpose() / points.cols();
  const Eigen::Vector3d s = covariance.jacobiSvd().singularValues().cwiseSqrt();
  return static_cast<int>((s.array() > kSamePoint * extent).count());
}

std::string name(const Component& component) {
  const int first = component.nodes.front();
  if (component.nodes.size() == 1) {
    return fmt::format("a component of the graph (node {} alone)", first);
  }
  return fmt::format("a component of the graph ({} nodes, the first is node {})",
                     component.nodes.size(), first);
}

std::vector<std::string> notes_on_free(const std::vector<Component>& free) {
  std::vector<std::string> notes;
  int lone = 0, unnamed = 0;
  for (const Component& component : free) {
    if (component.nodes.size() == 1) {
      ++lone;
    } else if (static_cast<int>(notes.size()) == kMostNamed) {
      ++unnamed;
    } else {
      notes.push_back(name(component) + " has no handle: it stays where it is");
    }
  }
  if (unnamed > 0) {
    notes.push_back(fmt::format(
        "components without a handle that stay where they are, besides these: {}", unnamed));
  }
  if (lone > 0) {
    notes.push_back(
        fmt::format("nodes without neighbour and handle, which stay where they are: {}", lone));
  }
  return notes;
}

}  // namespace

Pins pin_free_components(const DeformationGraph& graph, const Embedding& handles, double extent,
                         int dimension, std::vector<char>& fixed) {
  std::vector<Component> free;
  Pins pins;
  for (const Component& component : find_components(graph, handles, fixed)) {
    if (component.has_fixed_node) continue;
    if (component.handles.empty()) {
      free.push_back(component);
      continue;
    }
    const Eigen::Matrix3Xd places = handles.v(Eigen::all, component.handles);
    const int rank = affine_rank(places, extent);
    if (rank == 0) {
      pins.at_one_point.push_back({component.nodes, component.handles});
    } else if (!spans_a_plane(places, kNearLine)) {
      pins.on_one_line.push_back(component.handles);
    }
    if (rank < dimension - 1) {
      pins.notes.push_back(
          fmt::format("{} is pinned {} only, so that nothing tells how it turns about it; give "
                      "'rotate', or a handle beside it",
                      name(component), rank == 0 ? "at one point" : "on one line"));
    }
  }
  for (const Component& component : free) {
    for (const int j : component.nodes) fixed[j] = 1;
  }
  const std::vector<std::string> more = notes_on_free(free);
  pins.notes.insert(pins.notes.end(), more.begin(), more.end());
  return pins;
}

double influence_of_free(const Embedding& embedding, Eigen::Index column,
                         const std::vector<char>& fixed) {
  double sum = 0;
  for (Eigen::Index a = 0; a < embedding.nodes.rows(); ++a) {
    if (!fixed[embedding.nodes(a, column)]) sum += embedding.weights(a, column);
  }
  return sum;
}

int count_immovable(const Embedding& handles, Eigen::Index count, const std::vector<char>& fixed) {
  int immovable = 0;
  for (Eigen::Index l = 0; l < count; ++l) immovable += !(influence_of_free(handles, l, fixed) > 0);
  return immovable;
}

}  // namespace deformlab
