#pragma once

#include "energies/triangle/gradient.h"

namespace deformlab {

/// Igarashi et al. 2005, section 7: s_x s_y − 1, the relative change of a triangle's area. It does
/// not keep the shape, so that it is used together with another term.
struct Area {
  static constexpr std::string_view kName = "area";
  static constexpr bool kZeroAtRest = true, kRigidlyInvariant = true;

  RestTriangle rest;

  template <class T>
  Vector<T, 1> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>& v2) const {
    const Matrix<T, 2> J = rest.gradient(v0, v1, v2);
    return Vector<T, 1>(J(0, 0) * J(1, 1) - J(1, 0) * J(0, 1) - T(1));
  }

  static Terms<Area> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    return over_triangles<Area>(mesh, weights);
  }
};

}  // namespace deformlab
