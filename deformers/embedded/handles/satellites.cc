#include "deformers/embedded/handles/satellites.h"

#include <Eigen/Geometry>
#include <cmath>

#include "deformers/embedded/handles/handle_groups.h"

namespace deformlab {
namespace {

// The corners of a regular tetrahedron around the origin, at distance 1.
Eigen::Matrix<double, 3, 4> tetrahedron() {
  Eigen::Matrix<double, 3, 4> corners;
  corners << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  return corners / std::sqrt(3.0);
}

}  // namespace

Eigen::Matrix3Xd Satellites::places(const Eigen::Matrix3Xd& of_handles) const {
  return of_handles(Eigen::all, handles) + arms;
}

Eigen::Matrix3Xd Satellites::targets(const Eigen::Matrix3Xd& of_handles) const {
  return of_handles(Eigen::all, handles) + turned;
}

Satellites make_satellites(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& rotations,
                           std::span<const int> groups, double radius) {
  Satellites result;
  if (rotations.cols() == 0) return result;
  for (const std::vector<int>& group : handle_groups(v.cols(), groups)) {
    if (spans_a_plane(v(Eigen::all, group))) continue;
    for (const int l : group) {
      if (rotations.col(l).allFinite()) result.handles.insert(result.handles.end(), 4, l);
    }
  }
  const Eigen::Matrix<double, 3, 4> arms = radius * tetrahedron();
  result.arms.resize(3, std::ssize(result.handles));
  result.turned.resize(3, std::ssize(result.handles));
  for (Eigen::Index i = 0; i < result.count(); i += 4) {
    const Eigen::Vector3d turn = rotations.col(result.handles[i]);
    result.arms.middleCols<4>(i) = arms;
    const Eigen::AngleAxisd rotation(turn.norm(), turn.stableNormalized());
    result.turned.middleCols<4>(i) = rotation.toRotationMatrix() * arms;
  }
  return result;
}

}  // namespace deformlab
