#pragma once

#include "energies/term.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Igarashi et al. 2005, Eq. 12–16, one edge of one triangle: the difference between the edge and
/// that of the fitted triangle, whose position does not matter.
struct EdgeFit {
  static constexpr std::string_view kName = "edge_fit";
  static constexpr Structure kStructure = Structure::kKronecker;
  static constexpr bool kZeroAtRest = true;

  int i, j;                ///< corners among all 3·#F corners of the triangles
  Eigen::Vector2d fitted;  ///< v_j − v_i of the fitted triangle [length]

  template <class T>
  Vector<T, 2> operator()(const Vector<T, 2>& v_i, const Vector<T, 2>& v_j) const {
    return v_j - v_i - fitted;
  }

  void set_targets(const Eigen::MatrixXd& corners) { fitted = corners.col(j) - corners.col(i); }

  /// The three edges of every triangle, so that an edge between two triangles counts twice. Targets
  /// are the 2×3·#F corners of the fitted triangles; until they are set, those of the shape at rest
  /// take their place. One weight for each triangle.
  static Terms<EdgeFit> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    Terms<EdgeFit> sum;
    for (int f = 0; f < mesh.F.cols(); ++f) {
      for (int c = 0; c < 3; ++c) {
        const int i = mesh.F(c, f), j = mesh.F((c + 1) % 3, f);
        const Eigen::Vector2d edge = mesh.V.col(j) - mesh.V.col(i);
        sum.add({3 * f + c, 3 * f + (c + 1) % 3, edge}, {i, j}, weights[f]);
      }
    }
    return sum;
  }
};

}  // namespace deformlab
