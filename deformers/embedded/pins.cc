#include "deformers/embedded/pins.h"

#include <Eigen/SVD>
#include <algorithm>

namespace deformlab {
namespace {

constexpr int kMostNamed = 5;        // components in the notes; more are counted
constexpr double kSamePlace = 1e-6;  // of the shape's extent

struct Component {
  std::vector<int> nodes;
  std::vector<int> handles;
  bool anchored = false;  // by a fixed node
};

std::vector<Component> find_components(const DeformationGraph& graph, const Embedding& handles,
                                       const std::vector<char>& fixed) {
  std::vector<Component> result;
  const std::vector<int> component = components(graph);
  for (std::size_t j = 0; j < component.size(); ++j) {
    result.resize(std::max<std::size_t>(result.size(), component[j] + 1));
    result[component[j]].nodes.push_back(static_cast<int>(j));
    result[component[j]].anchored |= fixed[j] != 0;
  }
  // A graph made by hand, or cut, need not join the nodes that a handle follows.
  for (int l = 0; l < handles.v.cols(); ++l) {
    for (Eigen::Index a = 0; a < handles.nodes.rows(); ++a) {
      std::vector<int>& known = result[component[handles.nodes(a, l)]].handles;
      const bool is_new = known.empty() || known.back() != l;
      if (is_new && handles.weights(a, l) > 0) known.push_back(l);
    }
  }
  return result;
}

// 0, 1, 2, 3: all points in one place, on a line, in a plane, in space.
int affine_rank(const Eigen::Matrix3Xd& points, double extent) {
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::Matrix3d covariance = centred * centred.transpose() / points.cols();
  const Eigen::Vector3d s = covariance.jacobiSvd().singularValues().cwiseSqrt();
  return static_cast<int>((s.array() > kSamePlace * extent).count());
}

std::string name(const Component& component) {
  const std::string first = "node " + std::to_string(component.nodes.front());
  if (component.nodes.size() == 1) return "a component of the graph (" + first + " alone)";
  return "a component of the graph (" + std::to_string(component.nodes.size()) +
         " nodes, the first is " + first + ")";
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
    notes.push_back("components without a handle that stay where they are, besides these: " +
                    std::to_string(unnamed));
  }
  if (lone > 0) {
    notes.push_back("nodes without neighbour and handle, which stay where they are: " +
                    std::to_string(lone));
  }
  return notes;
}

}  // namespace

Pins hold_free_components(const DeformationGraph& graph, const Embedding& handles, double extent,
                          std::vector<char>& fixed) {
  std::vector<Component> free;
  Pins holds;
  for (const Component& component : find_components(graph, handles, fixed)) {
    if (component.anchored) continue;
    if (component.handles.empty()) {
      free.push_back(component);
      continue;
    }
    const int rank = affine_rank(handles.v(Eigen::all, component.handles), extent);
    if (rank == 0) holds.at_one_point.push_back({component.nodes, component.handles});
    if (rank < 2) {
      holds.notes.push_back(name(component) + " is held " +
                            (rank == 0 ? "at one point" : "on one line") +
                            " only: it may turn about it freely");
    }
  }
  for (const Component& component : free) {
    for (const int j : component.nodes) fixed[j] = 1;
  }
  const std::vector<std::string> more = notes_on_free(free);
  holds.notes.insert(holds.notes.end(), more.begin(), more.end());
  return holds;
}

int count_immovable(const Embedding& handles, const std::vector<char>& fixed) {
  int count = 0;
  for (Eigen::Index l = 0; l < handles.v.cols(); ++l) {
    bool movable = false;
    for (Eigen::Index a = 0; a < handles.nodes.rows(); ++a) {
      movable |= handles.weights(a, l) > 0 && fixed[handles.nodes(a, l)] == 0;
    }
    count += !movable;
  }
  return count;
}

}  // namespace deformlab
