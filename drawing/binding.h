#pragma once

#include <Eigen/Core>

#include "geometry/plane/locator.h"

namespace deformlab {

/// Points that follow a triangulation. Each keeps its barycentric coordinates in the triangle that
/// contains it (Igarashi et al. 2005, section 3). A point outside of all triangles follows the
/// affine map of the nearest one.
class Binding {
 public:
  Binding() = default;
  Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points);

  /// The positions of the points (2×n) when the vertices are at V (2×#V).
  Eigen::Matrix2Xd operator()(const Eigen::Matrix2Xd& V) const;

  int triangle(Eigen::Index point) const { return triangle_[point]; }
  /// The distance of each point from the triangulation at rest [length].
  const Eigen::VectorXd& outside() const { return outside_; }

 private:
  Eigen::Matrix3Xi corners_;
  Eigen::VectorXi triangle_;
  Eigen::Matrix3Xd b_;  ///< barycentric coordinates; some are negative for points outside
  Eigen::VectorXd outside_;
};

/// The barycentric coordinates of any point for a triangle (2×3 corners, area not zero).
Eigen::Vector3d barycentric(const Eigen::Matrix<double, 2, 3>& corners,
                            const Eigen::Vector2d& point);

/// The corners of triangle f.
Eigen::Matrix<double, 2, 3> corners(const Eigen::Matrix2Xd& V, const Eigen::Matrix3Xi& F,
                                    Eigen::Index f);

}  // namespace deformlab
