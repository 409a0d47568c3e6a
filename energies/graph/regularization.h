#pragma once

#include <Eigen/Geometry>

#include "energies/graph/sums.h"

namespace deformlab {

/// E_reg, Sumner et al. 2007, Eq. 7, one directed edge j → k: node j predicts where node k goes.
template <class Node = AffineNode<3>>
struct Regularization {
  static constexpr std::string_view kName = "regularization";
  static constexpr Structure kStructure =
      Node::kLinear ? Structure::kKronecker : Structure::kNonlinear;
  static constexpr double kWeight = 10;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;
  static constexpr int d = Node::kDimension;

  Vector<double, d> g_jk;  ///< g_k − g_j at rest [length]

  template <class T>
  Vector<T, d> operator()(const State<Node, T>& j, const State<Node, T>& k) const {
    return j.rotated(g_jk) - g_jk + j.t - k.t;
  }

  /// a of ∂r/∂X = aᵀ ⊗ I_d.
  Eigen::Matrix<double, d + 1, 2> coefficients(int) const requires Node::kLinear {
    Eigen::Matrix<double, d + 1, 2> a = Eigen::Matrix<double, d + 1, 2>::Zero();
    a.col(0) = g_jk.homogeneous();
    a(d, 1) = -1;
    return a;
  }

  /// b of r = X a − b.
  Vector<double, d> offset(int) const requires Node::kLinear { return g_jk; }

  /// ∂r/∂(ω_j, t_j, ω_k, t_k) of rigid nodes.
  Eigen::Matrix<double, 3, 12> jacobian(const Rigid<double>& j, const Rigid<double>&) const
      requires(!Node::kLinear) {
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 3, 12> J;
    J << rotated_jacobian(j.omega, g_jk), I, Eigen::Matrix3d::Zero(), -I;
    return J;
  }

  static Terms<Regularization> over(const GraphContext& context) {
    const Eigen::Matrix3Xd& g = context.graph.g;
    return over_edges<Regularization>(context, [&](int j, int k) {
      return Regularization{(g.col(k) - g.col(j)).template head<d>()};
    });
  }
};

}  // namespace deformlab
