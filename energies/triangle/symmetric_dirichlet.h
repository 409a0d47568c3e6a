#pragma once

#include "energies/triangle/gradient.h"

namespace deformlab {

/// The symmetric Dirichlet energy (Smith and Schaefer 2015) without its value at rest:
/// ‖J‖² + ‖J⁻¹‖² − 4 = ‖J − J⁻ᵀ‖². It grows without bound as a triangle collapses, so that no step
/// that lowers F turns one inside out.
struct SymmetricDirichlet {
  static constexpr std::string_view kName = "symmetric_dirichlet";
  static constexpr bool kZeroAtRest = true, kRigidlyInvariant = true;
  /// It can only begin where no triangle is inside out.
  static constexpr bool kNeedsOrientation = true;

  RestTriangle rest;

  template <class T>
  Vector<T, 4> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>& v2) const {
    constexpr double kLeast =
        1e-9;  // a smaller determinant counts as this, and is as good as a wall
    const Matrix<T, 2> J = rest.gradient(v0, v1, v2);
    T det = J(0, 0) * J(1, 1) - J(1, 0) * J(0, 1);
    if (!(det > T(kLeast))) det = T(kLeast);
    return Vector<T, 4>(J(0, 0) - J(1, 1) / det, J(1, 0) + J(0, 1) / det, J(0, 1) + J(1, 0) / det,
                        J(1, 1) - J(0, 0) / det);
  }

  static Terms<SymmetricDirichlet> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    return over_triangles<SymmetricDirichlet>(mesh, weights);
  }
};

}  // namespace deformlab
