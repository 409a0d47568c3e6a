#pragma once

#include <Eigen/Geometry>
#include <array>

#include "energies/term.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 8, one handle: where Eq. 2 takes the vertex, against where it should be.
struct Constraint {
  static constexpr std::string_view kName = "constraint";
  static constexpr Structure kStructure = Structure::kSeparable;
  static constexpr double kWeight = 100;
  static constexpr bool kZeroAtRest = true;

  Eigen::Vector3d v, q;                          ///< at rest, and the target [length]
  std::array<double, kMaxNeighbors> w;           ///< w_j(v)
  std::array<Eigen::Vector3d, kMaxNeighbors> g;  ///< g_j [length]
  int index;                                     ///< l: the column of its target

  template <class T>
  Vector3<T> operator()(std::span<const Affine<T>> nodes) const {
    Vector3<T> r = -q.cast<T>();
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      r += w[j] * (nodes[j].R * (v - g[j]) + g[j] + nodes[j].t);
    }
    return r;
  }

  /// ∂r/∂X = Σ_j w_j (v − g_j, 1)ᵀ ⊗ I₃, 3×12k.
  Eigen::Matrix3Xd jacobian(std::span<const Affine<double>> nodes) const {
    Eigen::Matrix3Xd J(3, 12 * nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const Eigen::Vector4d a = w[j] * (v - g[j]).homogeneous();
      for (int c = 0; c < 4; ++c)
        J.middleCols<3>(12 * j + 3 * c) = a[c] * Eigen::Matrix3d::Identity();
    }
    return J;
  }

  void aim(const Eigen::MatrixXd& targets) { q = targets.col(index); }

  /// All handles; until they are aimed they stay where they are.
  static Terms<Constraint> over(const DeformationGraph& graph, const Embedding& handles) {
    Terms<Constraint> sum{.arity = static_cast<int>(handles.nodes.rows())};
    for (int l = 0; l < handles.v.cols(); ++l) {
      const auto nodes = handles.nodes.col(l);
      Constraint c{handles.v.col(l), handles.v.col(l), {}, {}, l};
      for (int j = 0; j < sum.arity; ++j) {
        c.w[j] = handles.weights(j, l);
        c.g[j] = graph.g.col(nodes[j]);
      }
      sum.add(c, std::span(nodes.data(), nodes.size()));
    }
    return sum;
  }
};

}  // namespace deformlab
