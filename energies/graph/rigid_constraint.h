#pragma once

#include <array>

#include "energies/graph/rotation_vector.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 8, of nodes that are rotations by construction: where Eq. 2 takes the
/// vertex, against where it should be.
struct RigidConstraint {
  static constexpr std::string_view kName = "constraint";
  static constexpr Structure kStructure = Structure::kNonlinear;
  static constexpr double kWeight = 100;
  static constexpr bool kZeroAtRest = true;

  Eigen::Vector3d v, q;                          ///< at rest, and the target [length]
  std::array<double, kMaxNeighbors> w;           ///< w_j(v)
  std::array<Eigen::Vector3d, kMaxNeighbors> g;  ///< g_j [length]
  int index;                                     ///< l: the column of its target

  template <class T>
  Vector<T, 3> operator()(std::span<const Rigid<T>> nodes) const {
    Vector<T, 3> r = -q.template cast<T>();
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      r += w[j] * (turned<T>(nodes[j].col(0), v - g[j]) + g[j] + nodes[j].col(1));
    }
    return r;
  }

  /// ∂r/∂(ω, t) of each node, side by side.
  auto jacobian(std::span<const Rigid<double>> nodes) const {
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6 * kMaxNeighbors> J(3, 6 * nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      J.middleCols<3>(6 * j) = w[j] * turned_jacobian(nodes[j].col(0), v - g[j]);
      J.middleCols<3>(6 * j + 3) = w[j] * Eigen::Matrix3d::Identity();
    }
    return J;
  }

  void set_targets(const Eigen::MatrixXd& targets) { q = targets.col(index); }

  /// All handles; until they are aimed they stay where they are.
  static Terms<RigidConstraint> over(const DeformationGraph& graph, const Embedding& handles) {
    Terms<RigidConstraint> sum{.arity = static_cast<int>(handles.nodes.rows())};
    for (int l = 0; l < handles.v.cols(); ++l) {
      const auto nodes = handles.nodes.col(l);
      RigidConstraint c{handles.v.col(l), handles.v.col(l), {}, {}, l};
      for (int j = 0; j < sum.arity; ++j) {
        c.w[j] = handles.weights(j, l);
        c.g[j] = graph.g.col(nodes[j]);
      }
      sum.add(c, std::span(nodes.data(), nodes.size()));
    }
    return sum;
  }
  static Unknowns rest(const DeformationGraph& graph) { return rigid_rest(graph); }
};

}  // namespace deformlab
