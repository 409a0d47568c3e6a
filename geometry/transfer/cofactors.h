#pragma once

#include <Eigen/Geometry>

namespace deformlab {

/// det(F) F^{-T}, which transforms normals even where F is singular. Its columns are the cross
/// products of F's.
inline Eigen::Matrix3d cofactors(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d C;
  C << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  return C;
}

}  // namespace deformlab
