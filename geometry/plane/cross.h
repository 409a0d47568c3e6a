#pragma once

#include <Eigen/Core>

namespace deformlab {

/// The signed area of the parallelogram of u and v; it is positive where v turns from u like y from
/// x.
inline double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u[0] * v[1] - u[1] * v[0];
}

}  // namespace deformlab
