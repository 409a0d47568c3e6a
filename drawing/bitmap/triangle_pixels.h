#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "drawing/binding.h"

namespace deformlab {

/// The pixels whose first one is (left, top). Pixel (x, y) covers the unit square from (x, y) on.
struct PixelBox {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Calls visit(x, y, b) for each pixel of the box whose centre lies in the triangle. b are the
/// barycentric coordinates of the centre. Centres on an edge belong to both triangles. A triangle
/// without area contains no centre.
template <class Visit>
void for_each_pixel(const Eigen::Matrix<double, 2, 3>& corners, const PixelBox& box,
                    Visit&& visit) {
  constexpr double kOnEdge = 1e-9, kLeastArea = 1e-9;
  const Eigen::Vector3d at_zero = barycentric(corners, {0.5, 0.5});
  const Eigen::Vector3d by_x = barycentric(corners, {1.5, 0.5}) - at_zero;
  const Eigen::Vector3d by_y = barycentric(corners, {0.5, 1.5}) - at_zero;
  const double area = (corners.rightCols<2>().colwise() - corners.col(0)).determinant();
  if (!at_zero.allFinite() || std::abs(area) < kLeastArea) return;
  const auto clamped = [](double value, int from, int count) {
    return std::clamp(value, double{0} + from, double{0} + from + count - 1);
  };
  const Eigen::Vector2d least = corners.rowwise().minCoeff(), most = corners.rowwise().maxCoeff();
  if (most.y() < box.top || least.y() > box.top + box.height) return;
  const int first = static_cast<int>(clamped(std::floor(least.y() - 0.5), box.top, box.height));
  const int last = static_cast<int>(clamped(std::ceil(most.y() - 0.5), box.top, box.height));
  for (int y = first; y <= last; ++y) {
    const Eigen::Vector3d row = at_zero + by_y * y;
    double from = box.left, to = box.left + box.width - 1;
    for (int i = 0; i < 3; ++i) {
      const double edge = (-kOnEdge - row[i]) / by_x[i];
      if (by_x[i] > 0) from = std::max(from, std::ceil(edge));
      if (by_x[i] < 0) to = std::min(to, std::floor(edge));
      if (by_x[i] == 0 && row[i] < -kOnEdge) to = from - 1;
    }
    if (from > to) continue;
    for (int x = static_cast<int>(from); x <= to; ++x) visit(x, y, Eigen::Vector3d(row + by_x * x));
  }
}

}  // namespace deformlab
