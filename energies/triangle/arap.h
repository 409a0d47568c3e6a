#pragma once

#include "energies/triangle/gradient.h"

namespace deformlab {

/// The as-rigid-as-possible energy of one triangle: the distance of its map to the nearest
/// rotation. Weighted by the areas, this is the sum over edges with cotangent weights (Sorkine and
/// Alexa 2007; Liu et al. 2008).
struct Arap {
  static constexpr std::string_view kName = "arap";
  static constexpr bool kZeroAtRest = true, kRigidlyInvariant = true;

  RestTriangle rest;

  template <class T>
  Vector<T, 4> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>& v2) const {
    const Matrix<T, 2> J = rest.gradient(v0, v1, v2), off = J - nearest_rotation(J);
    return Vector<T, 4>(off(0, 0), off(1, 0), off(0, 1), off(1, 1));
  }

  static Terms<Arap> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    return over_triangles<Arap>(mesh, weights);
  }
};

}  // namespace deformlab
