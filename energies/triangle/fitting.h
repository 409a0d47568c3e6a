#pragma once

#include "energies/term.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Igarashi et al. 2005, Eq. 9–11, one triangle: the triangle that is similar to the one at rest
/// and fits the intermediate one best. Its unknowns are the first two corners, v0_fitted and
/// v1_fitted; the third follows by Eq. 10. It becomes congruent to the one at rest if it is scaled
/// by the length at rest divided by the fitted length (the printed factor is the inverse).
struct Fitting {
  static constexpr std::string_view kName = "fitting";
  static constexpr Structure kStructure = Structure::kLinear;
  static constexpr bool kZeroAtRest = true;

  Eigen::Vector2d local;          ///< x01, y01 of corner 2 [length of edge 01]
  Eigen::Vector3i corners;        ///< vertices of the mesh: columns of the targets
  Eigen::Matrix<double, 2, 3> v;  ///< v_i', the intermediate triangle [length]

  template <class T>
  Vector<T, 6> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1) const {
    Vector<T, 6> r;
    r << v0 - v.col(0), v1 - v.col(1), third(v0, v1) - v.col(2);
    return r;
  }

  /// The third corner by Eq. 10.
  template <class T>
  Vector<T, 2> third(const Vector<T, 2>& v0, const Vector<T, 2>& v1) const {
    const Vector<T, 2> v01 = v1 - v0, R90_v01(-v01.y(), v01.x());
    return v0 + local.x() * v01 + local.y() * R90_v01;
  }

  void set_targets(const Eigen::MatrixXd& intermediate) { v = intermediate(Eigen::all, corners); }

  /// All triangles, each with the nodes 2f and 2f + 1. Targets are the 2×#V intermediate positions;
  /// until they are set, the triangles fit the shape at rest. One weight for each triangle.
  static Terms<Fitting> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    Terms<Fitting> sum;
    for (int f = 0; f < mesh.F.cols(); ++f) {
      const Eigen::Vector3i corners = mesh.F.col(f);
      const Eigen::Matrix<double, 2, 3> v = mesh.V(Eigen::all, corners);
      const Eigen::Vector2d v01 = v.col(1) - v.col(0), R90_v01(-v01.y(), v01.x());
      const Eigen::Vector2d v02 = v.col(2) - v.col(0);
      const Eigen::Vector2d local(v02.dot(v01), v02.dot(R90_v01));
      sum.add({local / v01.squaredNorm(), corners, v}, {2 * f, 2 * f + 1}, weights[f]);
    }
    return sum;
  }

  /// v0 and v1 of every triangle at rest: 2·#F nodes with one column each.
  static Unknowns rest(const Triangulation& mesh) {
    const int nodes = 2 * static_cast<int>(mesh.F.cols());
    return Unknowns::uniform(mesh.V(Eigen::all, mesh.F.topRows<2>().reshaped()), nodes);
  }
};

}  // namespace deformlab
