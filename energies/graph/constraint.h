#pragma once

#include <Eigen/Geometry>

#include "energies/term.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 8, one handle: where Eq. 2 takes the vertex, against where it should be.
template <int d = 3>
struct Constraint {
  static constexpr std::string_view kName = "constraint";
  static constexpr Structure kStructure = Structure::kKronecker;
  static constexpr double kWeight = 100;
  static constexpr bool kZeroAtRest = true;

  using Point = Vector<double, d>;
  Point v, q;                                 ///< at rest, and the target [length]
  Vector<double, kMaxNeighbors> w;            ///< w_j(v)
  Eigen::Matrix<double, d, kMaxNeighbors> g;  ///< g_j [length]
  int index;                                  ///< l: the column of its target

  template <class T>
  Vector<T, d> operator()(std::span<const Affine<T, d>> nodes) const {
    Vector<T, d> r = -q.template cast<T>();
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      r += w[j] * (nodes[j].R * (v - g.col(j)) + g.col(j) + nodes[j].t);
    }
    return r;
  }

  /// a of ∂r/∂X = aᵀ ⊗ I_d: w_j (v − g_j, 1) for each of so many nodes.
  auto coefficients(int nodes) const {
    Eigen::Matrix<double, d + 1, Eigen::Dynamic, 0, d + 1, kMaxNeighbors> a(d + 1, nodes);
    for (int j = 0; j < nodes; ++j) a.col(j) = w[j] * (v - g.col(j)).homogeneous();
    return a;
  }

  /// And b of r = X a − b.
  Point offset(int nodes) const { return q - g.leftCols(nodes) * w.head(nodes); }

  void set_targets(const Eigen::MatrixXd& targets) { q = targets.col(index); }

  /// All handles; until they are aimed they stay where they are.
  static Terms<Constraint> over(const DeformationGraph& graph, const Embedding& handles) {
    Terms<Constraint> sum{.arity = static_cast<int>(handles.nodes.rows())};
    sum.reserve(handles.v.cols());
    for (int l = 0; l < handles.v.cols(); ++l) {
      const auto nodes = handles.nodes.col(l);
      const Point v = handles.v.col(l).template head<d>();
      Constraint c{v, v, {}, {}, l};
      c.w.head(sum.arity) = handles.weights.col(l);
      c.g.leftCols(sum.arity) = graph.g(Eigen::all, nodes).template topRows<d>();
      sum.add(c, std::span(nodes.data(), nodes.size()));
    }
    return sum;
  }
};

}  // namespace deformlab
