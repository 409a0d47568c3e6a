#pragma once

#include "energies/triangle/gradient.h"

namespace deformlab {

/// Igarashi et al. 2005, section 7, Eq. 17, which the paper proposes without an experiment: the map
/// of a triangle is a rotation times a symmetric matrix (s_x s_h; s_h s_y), and s_x − 1, s_y − 1
/// and the shear s_h are penalised. The paper minimises absolute values; a loss of this term does
/// so approximately.
struct StretchShear {
  static constexpr std::string_view kName = "stretch_shear";
  static constexpr bool kZeroAtRest = true, kRigidlyInvariant = true;

  RestTriangle rest;

  template <class T>
  Vector<T, 3> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>& v2) const {
    const Matrix<T, 2> J = rest.gradient(v0, v1, v2), R = nearest_rotation(J);
    const Matrix<T, 2> S = R.transpose() * J;
    return Vector<T, 3>(S(0, 0) - T(1), S(1, 1) - T(1), S(0, 1));
  }

  static Terms<StretchShear> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    return over_triangles<StretchShear>(mesh, weights);
  }
};

}  // namespace deformlab
