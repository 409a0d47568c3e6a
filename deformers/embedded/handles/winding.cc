#include "deformers/embedded/handles/winding.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "deformers/embedded/node_states.h"

namespace deformlab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The rotation vector of R that is nearest to `before`. Full turns are added along the axis of R.
// Near a full turn, where R has hardly an axis, they are added along `before`.
Eigen::Vector3d continued(const Eigen::Matrix3d& R, const Eigen::Vector3d& before) {
  const Eigen::AngleAxisd turn(R);
  const double full = 2 * std::numbers::pi;
  const auto wound = [&](const Eigen::Vector3d& axis) {
    const Eigen::Vector3d least = turn.angle() * turn.axis();
    return Eigen::Vector3d(least + full * std::round(axis.dot(before - least) / full) * axis);
  };
  Eigen::Vector3d along_axis = wound(turn.axis());
  if (!(before.norm() > 0)) return along_axis;
  Eigen::Vector3d along_before = wound(before.normalized());
  const bool is_axis = (along_axis - before).norm() <= (along_before - before).norm();
  if (is_axis || turn.angle() > std::numbers::pi / 2) return along_axis;
  return along_before;
}

// The largest angle that is known [rad].
double largest_angle(const Eigen::Matrix3Xd& rotations) {
  double largest = 0;
  for (const auto turn : rotations.colwise()) {
    if (turn.allFinite()) largest = std::max(largest, turn.norm());
  }
  return largest;
}

// The rotation vectors (3×m) of nodes at rest; NaN for the others.
Eigen::Matrix3Xd known_at_rest(const std::vector<char>& at_rest) {
  Eigen::Matrix3Xd omega = Eigen::Matrix3Xd::Constant(3, std::ssize(at_rest), kNaN);
  for (std::size_t j = 0; j < at_rest.size(); ++j) {
    if (at_rest[j]) omega.col(static_cast<Eigen::Index>(j)).setZero();
  }
  return omega;
}

// Sets the columns of omega (3×m) that are NaN, from the known ones along the edges of the graph:
// of(node, the rotation vector of the neighbour that is known).
template <class Of>
void spread(const DeformationGraph& graph, Eigen::Matrix3Xd& omega, const Of& of) {
  std::vector<std::vector<int>> neighbors(static_cast<std::size_t>(omega.cols()));
  for (const GraphEdge& edge : graph.edges) {
    neighbors[edge.j].push_back(edge.k);
    neighbors[edge.k].push_back(edge.j);
  }
  std::queue<int> queue;
  for (int j = 0; j < omega.cols(); ++j) {
    if (omega.col(j).allFinite()) queue.push(j);
  }
  for (; !queue.empty(); queue.pop()) {
    for (const int k : neighbors[queue.front()]) {
      if (omega.col(k).allFinite()) continue;
      omega.col(k) = of(k, omega.col(queue.front()));
      queue.push(k);
    }
  }
}

}  // namespace

double turn_between_neighbors(const DeformationGraph& graph, const Embedding& handles,
                              const Eigen::Matrix3Xd& rotations, const std::vector<char>& at_rest) {
  if (largest_angle(rotations) == 0) return 0;
  Eigen::Matrix3Xd omega = known_at_rest(at_rest);
  for (Eigen::Index l = 0; l < rotations.cols(); ++l) {
    if (rotations.col(l).allFinite()) omega.col(handles.nodes(0, l)) = rotations.col(l);
  }
  spread(graph, omega, [](int, const Eigen::Vector3d& neighbor) { return neighbor; });
  double largest = 0;
  for (const GraphEdge& edge : graph.edges) {
    const double turn = (omega.col(edge.j) - omega.col(edge.k)).norm();
    if (turn > largest) largest = turn;  // not where nothing is known
  }
  return largest;
}

Eigen::Matrix3Xd unwound_rotations(const DeformationGraph& graph, const Transformations& X,
                                   const std::vector<char>& at_rest) {
  Eigen::Matrix3Xd omega = known_at_rest(at_rest);
  spread(graph, omega, [&](int node, const Eigen::Vector3d& neighbor) {
    return continued(nearest_rotation(X.middleCols<3>(4 * node)), neighbor);
  });
  return omega;
}

std::optional<std::string> lost_turn(const DeformationGraph& graph, const Transformations& X,
                                     const Embedding& handles, const Eigen::Matrix3Xd& rotations,
                                     const std::vector<char>& at_rest) {
  if (largest_angle(rotations) < kMoreThanHalfTurn) return std::nullopt;
  const Eigen::Matrix3Xd omega = unwound_rotations(graph, X, at_rest);
  double lost = 0;
  for (Eigen::Index l = 0; l < rotations.cols(); ++l) {
    const double off = (omega.col(handles.nodes(0, l)) - rotations.col(l)).norm();
    if (off > std::numbers::pi) lost = std::max(lost, rotations.col(l).norm());
  }
  if (lost == 0) return std::nullopt;
  return fmt::format(
      "the shape does not hold a turn of {:.0f} degrees: it unwinds by a full turn (360 degrees); "
      "turn the region less, or take its middle along with handles of its own",
      lost * 180 / std::numbers::pi);
}

}  // namespace deformlab
