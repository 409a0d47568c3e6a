#pragma once

#include <Eigen/Core>

#include "geometry/plane/locator.h"

namespace deformlab {

/// Points that follow a triangulation: each keeps its barycentric coordinates in the triangle that
/// it lies in (Igarashi et al. 2005, section 3), or, outside of all, those it has beyond the
/// nearest one, whose affine map is continued there.
class Binding {
 public:
  Binding() = default;
  Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points);

  /// 2×n: where the points are once the vertices are at V (2×#V).
  Eigen::Matrix2Xd operator()(const Eigen::Matrix2Xd& V) const;

  int triangle(Eigen::Index point) const { return triangle_[point]; }
  /// Distance from the triangulation at rest [length].
  const Eigen::VectorXd& outside() const { return outside_; }

 private:
  Eigen::Matrix3Xi corners_;
  Eigen::VectorXi triangle_;
  Eigen::Matrix3Xd b_;  ///< of sum one; negative ones outside
  Eigen::VectorXd outside_;
};

/// The barycentric coordinates of a point in a triangle (2×3 corners of non-zero area), wherever it
/// is.
Eigen::Vector3d barycentric(const Eigen::Matrix<double, 2, 3>& corners,
                            const Eigen::Vector2d& point);

/// The corners of triangle f.
Eigen::Matrix<double, 2, 3> corners(const Eigen::Matrix2Xd& V, const Eigen::Matrix3Xi& F,
                                    Eigen::Index f);

}  // namespace deformlab
