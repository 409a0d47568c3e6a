#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "energies/signature.h"

namespace deformlab {

/// a = sin θ / θ and b = (1 − cos θ) / θ² as functions of θ². Near θ = 0, where both are 0/0, their
/// series have the right derivatives too.
template <class T>
struct Rodrigues {
  static constexpr double kSmall = 1e-4;  // further terms of the series are below rounding errors
  T a, b;

  explicit Rodrigues(const T& square)
      : a(T(1) - square / 6.0 * (T(1) - square / 20.0)),
        b(T(0.5) - square / 24.0 * (T(1) - square / 30.0)) {
    using std::sin, std::sqrt;
    if (!(square > T(kSmall))) return;
    const T angle = sqrt(square), half = sin(angle / 2.0) / angle;
    a = sin(angle) / angle;
    b = 2.0 * half * half;
  }
};

/// v rotated about ω by the angle ‖ω‖: exp(ω) v = v + a ω × v + b ω × (ω × v), Rodrigues' formula.
template <class T>
Vector<T, 3> rotated(const Vector<T, 3>& omega, const Eigen::Vector3d& v) {
  const Rodrigues<T> by(omega.squaredNorm());
  const Vector<T, 3> once = omega.cross(v.cast<T>().eval());
  return v.cast<T>() + by.a * once + by.b * omega.cross(once);
}

/// ∂(exp(ω) v)/∂ω = −exp(ω) [v]× (I − b [ω]× + c [ω]×²), c = (1 − a) / θ².
inline Eigen::Matrix3d rotated_jacobian(const Eigen::Vector3d& omega, const Eigen::Vector3d& v) {
  const double square = omega.squaredNorm();
  const Rodrigues<double> by(square);
  const double c = square > by.kSmall ? (1 - by.a) / square : (1 - square / 20) / 6;
  Eigen::Matrix3d J;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d once = omega.cross(Eigen::Vector3d::Unit(i));
    const Eigen::Vector3d turn = Eigen::Vector3d::Unit(i) - by.b * once + c * omega.cross(once);
    J.col(i) = rotated<double>(omega, turn.cross(v));
  }
  return J;
}

}  // namespace deformlab
