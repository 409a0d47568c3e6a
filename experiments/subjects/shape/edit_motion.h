#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiments/subjects/shape/edit.h"

namespace deformlab {

/// The motion that an entry gives to its selection, whose rest positions are P (3×#) [length]. It
/// is that of `rotate`, `scale`, `by`, `to` and `matrix`; `fix` moves nothing.
Motion motion_of(const EditEntry& entry, const Eigen::Matrix3Xd& P);

/// Whether the motion neither rotates nor changes the size.
bool is_translation(const Motion& motion);

/// Whether three or more points P (3×#) go to Q (3×#) [length] by one rotation and translation, up
/// to a hundredth of their extent.
bool is_rigid_motion(const Eigen::Matrix3Xd& P, const Eigen::Matrix3Xd& Q);

/// A handle on its way: where it is at rest, how far it is from there, and by which motion.
struct Pose {
  Eigen::Vector3d rest, offset;  ///< [length]
  Motion motion;
};

/// A pose as numbers each of which can be interpolated by itself: the rotation vector, the stretch
/// and the centre of the motion, the place at rest, and the translation.
using PoseNumbers = Eigen::Matrix<double, 21, 1>;
inline constexpr int kTurnOfNumbers = 0;  ///< the first of the three numbers of the rotation vector

/// The numbers of poses between which a handle goes. A translation has any centre, and so it takes
/// that of the nearest pose, or of the earlier of two, that is none.
std::vector<PoseNumbers> numbers_of(const std::vector<Pose>& poses);

/// The offset of a handle from its place at rest [length].
Eigen::Vector3d offset_of(const PoseNumbers& numbers);

/// The offset of a handle on its way from one pose to another, by the share of the way that is done
/// (0 to 1). Rotation vectors, stretches, centres and translations change in proportion, so that a
/// rotation goes along an arc and may exceed a half turn. Two translations give a straight line.
Eigen::Vector3d offset_between(const Pose& from, const Pose& to, double share);

}  // namespace deformlab
