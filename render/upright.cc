#include "render/upright.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace deformlab {
namespace {

constexpr double kLowest = 0.03;  // the height of the lowest vertices, as a share of the whole
constexpr double kWider = 2;      // a stand this much wider than another decides

// The area of a box, seen along an axis.
double area(const Eigen::AlignedBox3d& box, int axis) {
  const Eigen::Vector3d size = box.sizes();
  return size[(axis + 1) % 3] * size[(axis + 2) % 3];
}

double stand(const Eigen::Matrix3Xd& V, int axis) {
  const double low = V.row(axis).minCoeff(), height = V.row(axis).maxCoeff() - low;
  Eigen::AlignedBox3d all, lowest;
  for (const auto v : V.colwise()) {
    all.extend(Eigen::Vector3d(v));
    if (v[axis] <= low + kLowest * height) lowest.extend(Eigen::Vector3d(v));
  }
  const double whole = area(all, axis);
  return whole > 0 ? area(lowest, axis) / whole : 0;
}

}  // namespace

Eigen::Vector3d upright_axis(const Eigen::Matrix3Xd& V) {
  if (V.cols() == 0) return Eigen::Vector3d::UnitZ();
  Eigen::Matrix3Xd on_its_head = V;
  on_its_head.row(1) *= -1;
  const bool is_y = stand(V, 1) > kWider * std::max(stand(on_its_head, 1), stand(V, 2));
  return is_y ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
}

}  // namespace deformlab
