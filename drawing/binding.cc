#include "drawing/binding.h"

#include "geometry/plane/cross.h"

namespace deformlab {

Eigen::Vector3d barycentric(const Eigen::Matrix<double, 2, 3>& c, const Eigen::Vector2d& point) {
  const Eigen::Vector2d e1 = c.col(1) - c.col(0), e2 = c.col(2) - c.col(0);
  const Eigen::Vector2d p = point - c.col(0);
  const double area = cross(e1, e2);
  const double b1 = cross(p, e2) / area, b2 = cross(e1, p) / area;
  return {1 - b1 - b2, b1, b2};
}

Eigen::Matrix<double, 2, 3> corners(const Eigen::Matrix2Xd& V, const Eigen::Matrix3Xi& F,
                                    Eigen::Index f) {
  Eigen::Matrix<double, 2, 3> c;
  for (int i = 0; i < 3; ++i) c.col(i) = V.col(F(i, f));
  return c;
}

Binding::Binding(const Triangulation& rest, const Locator& locator, const Eigen::Matrix2Xd& points)
    : corners_(3, points.cols()),
      triangle_(points.cols()),
      b_(3, points.cols()),
      outside_(points.cols()) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Located place = locator(points.col(i));
    triangle_[i] = place.triangle;
    outside_[i] = place.distance;
    corners_.col(i) = rest.F.col(place.triangle);
    b_.col(i) = barycentric(corners(rest.V, rest.F, place.triangle), points.col(i));
  }
}

Eigen::Matrix2Xd Binding::operator()(const Eigen::Matrix2Xd& V) const {
  Eigen::Matrix2Xd points(2, b_.cols());
  for (Eigen::Index i = 0; i < b_.cols(); ++i) points.col(i) = corners(V, corners_, i) * b_.col(i);
  return points;
}

}  // namespace deformlab
