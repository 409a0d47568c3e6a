#pragma once

#include <Eigen/Core>
#include <optional>

namespace deformlab {

/// Handles off a line by less than this share of its length hardly hold the roll about it: if one
/// is moved by some of its distance to the line, the shape rolls by as many tens of degrees.
inline constexpr double kNearLine = 0.1;

/// The rotation vector [rad] of the shortest turn that takes the line through the points p (3×#) to
/// the line through q (3×#) [length]. It does not roll about the line, of which points on a line
/// tell nothing. A half turn is about the axis nearest to z. Returns nothing where the points p or
/// q are at one place.
std::optional<Eigen::Vector3d> shortest_turn(const Eigen::Matrix3Xd& p, const Eigen::Matrix3Xd& q);

}  // namespace deformlab
