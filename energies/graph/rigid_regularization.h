#pragma once

#include "energies/graph/rotation_vector.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 7, of nodes that are rotations by construction: node j predicts where
/// node k goes.
struct RigidRegularization {
  static constexpr std::string_view kName = "regularization";
  static constexpr Structure kStructure = Structure::kNonlinear;
  static constexpr double kWeight = 10;
  static constexpr bool kZeroAtRest = true;

  Eigen::Vector3d g_jk;  ///< g_k − g_j at rest [length]

  template <class T>
  Vector<T, 3> operator()(const Rigid<T>& j, const Rigid<T>& k) const {
    return turned<T>(j.col(0), g_jk) - g_jk + j.col(1) - k.col(1);
  }

  /// ∂r/∂(ω_j, t_j, ω_k, t_k).
  Eigen::Matrix<double, 3, 12> jacobian(const Rigid<double>& j, const Rigid<double>&) const {
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 3, 12> J;
    J << turned_jacobian(j.col(0), g_jk), I, Eigen::Matrix3d::Zero(), -I;
    return J;
  }

  /// Both directions of every edge, each weighted by α_jk.
  static Terms<RigidRegularization> over(const DeformationGraph& graph) {
    Terms<RigidRegularization> sum{.arity = 2};
    for (const auto& [j, k, alpha] : graph.edges) {
      const Eigen::Vector3d g_jk = graph.g.col(k) - graph.g.col(j);
      sum.add({g_jk}, {j, k}, alpha);
      sum.add({-g_jk}, {k, j}, alpha);
    }
    return sum;
  }
  static Unknowns rest(const DeformationGraph& graph) { return rigid_rest(graph); }
};

}  // namespace deformlab
