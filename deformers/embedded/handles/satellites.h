#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace deformlab {

/// Four places around each handle whose rotation is asked for and does not follow from where the
/// handles of its group go, because these lie on a line or at one point. They are embedded like
/// handles that are points, so that the nodes around them turn with the handle. The sum of their
/// arms is zero and the sum of the squares is the same in all directions: they hold a rotation and
/// no position.
struct Satellites {
  std::vector<int> handles;  ///< of each satellite, its handle
  Eigen::Matrix3Xd arms;     ///< 3×#, from the handle at rest to the satellite [length]
  Eigen::Matrix3Xd turned;   ///< 3×#, from the handle's target to that of the satellite [length]

  Eigen::Index count() const { return arms.cols(); }
  /// 3×count() places for the places (3×#handles) of the handles at rest [length].
  Eigen::Matrix3Xd places(const Eigen::Matrix3Xd& of_handles) const;
  /// 3×count() targets for the targets (3×#handles) of the handles [length].
  Eigen::Matrix3Xd targets(const Eigen::Matrix3Xd& of_handles) const;
};

/// The satellites of handles at v (3×#handles) [length].
///   rotations, groups  as in Handles
///   radius             the length of an arm [length]
Satellites make_satellites(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& rotations,
                           std::span<const int> groups, double radius);

}  // namespace deformlab
