#pragma once

#include <Eigen/Geometry>

#include "energies/graph/sums.h"

namespace deformlab {

/// E_con, Sumner et al. 2007, Eq. 8, one handle: the difference between the deformed position of
/// the vertex (Eq. 2) and its target.
template <class Node = AffineNode<3>>
struct Constraint {
  static constexpr std::string_view kName = "constraint";
  static constexpr Structure kStructure =
      Node::kLinear ? Structure::kKronecker : Structure::kNonlinear;
  static constexpr double kWeight = 100;
  static constexpr bool kZeroAtRest = true;
  static constexpr int d = Node::kDimension;

  using Point = Vector<double, d>;
  Point v, q;                                 ///< at rest, and the target [length]
  Vector<double, kMaxNeighbors> w;            ///< w_j(v)
  Eigen::Matrix<double, d, kMaxNeighbors> g;  ///< g_j [length]
  int index;                                  ///< l: the column of its target

  template <class T>
  Vector<T, d> operator()(NodeList<State<Node, T>> nodes) const {
    Vector<T, d> r = -q.template cast<T>();
    for (int j = 0; j < nodes.size(); ++j) {
      const State<Node, T> node = nodes[j];
      r += w[j] * (node.rotated(v - g.col(j)) + g.col(j) + node.t);
    }
    return r;
  }

  /// a of ∂r/∂X = aᵀ ⊗ I_d: w_j (v − g_j, 1) for each of the nodes.
  auto coefficients(int nodes) const requires Node::kLinear {
    Eigen::Matrix<double, d + 1, Eigen::Dynamic, 0, d + 1, kMaxNeighbors> a(d + 1, nodes);
    for (int j = 0; j < nodes; ++j) a.col(j) = w[j] * (v - g.col(j)).homogeneous();
    return a;
  }

  /// b of r = X a − b.
  Point offset(int nodes) const requires Node::kLinear {
    return q - g.leftCols(nodes) * w.head(nodes);
  }

  /// ∂r/∂(ω_j, t_j) of each rigid node, side by side.
  auto jacobian(NodeList<Rigid<double>> nodes) const requires(!Node::kLinear) {
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6 * kMaxNeighbors> J(3, 6 * nodes.size());
    for (int j = 0; j < nodes.size(); ++j) {
      J.template middleCols<3>(6 * j) = w[j] * rotated_jacobian(nodes[j].omega, v - g.col(j));
      J.template middleCols<3>(6 * j + 3) = w[j] * Eigen::Matrix3d::Identity();
    }
    return J;
  }

  void set_targets(const Eigen::MatrixXd& targets) { q = targets.col(index); }

  /// Until their targets are set, the handles stay where they are at rest.
  static Terms<Constraint> over(const GraphContext& context) {
    const Embedding& handles = context.handles;
    const auto k = handles.nodes.rows();
    return over_handles<Constraint>(context, [&](int l) {
      const Point rest = handles.v.col(l).template head<d>();
      Constraint c{rest, rest, {}, {}, l};
      c.w.head(k) = handles.weights.col(l);
      c.g.leftCols(k) = context.graph.g(Eigen::all, handles.nodes.col(l)).template topRows<d>();
      return c;
    });
  }
};

}  // namespace deformlab
