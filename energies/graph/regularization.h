#pragma once

#include <Eigen/Geometry>

#include "energies/term.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 7, one directed edge j → k: node j predicts where node k goes.
template <int d = 3>
struct Regularization {
  static constexpr std::string_view kName = "regularization";
  static constexpr Structure kStructure = Structure::kKronecker;
  static constexpr double kWeight = 10;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;

  Vector<double, d> g_jk;  ///< g_k − g_j at rest [length]

  template <class T>
  Vector<T, d> operator()(const Affine<T, d>& j, const Affine<T, d>& k) const {
    return j.R * g_jk - g_jk + j.t - k.t;
  }

  /// a of ∂r/∂X = aᵀ ⊗ I_d.
  Eigen::Matrix<double, d + 1, 2> coefficients(int) const {
    Eigen::Matrix<double, d + 1, 2> a = Eigen::Matrix<double, d + 1, 2>::Zero();
    a.col(0) = g_jk.homogeneous();
    a(d, 1) = -1;
    return a;
  }

  /// And b of r = X a − b.
  Vector<double, d> offset(int) const { return g_jk; }

  /// Both directions of every edge, each weighted by α_jk.
  static Terms<Regularization> over(const DeformationGraph& graph) {
    Terms<Regularization> sum{.arity = 2};
    for (const auto& [j, k, alpha] : graph.edges) {
      const Vector<double, d> g_jk = (graph.g.col(k) - graph.g.col(j)).template head<d>();
      sum.add({g_jk}, {j, k}, alpha);
      sum.add({-g_jk}, {k, j}, alpha);
    }
    return sum;
  }
};

}  // namespace deformlab
