#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace deformlab {

/// The handles of each group (Handles::groups), by the groups' numbers. Without groups, each handle
/// is one by itself.
std::vector<std::vector<int>> handle_groups(Eigen::Index handles, std::span<const int> groups);

/// The extent of points on a line, relative to their length, below which they span no plane.
inline constexpr double kFlat = 1e-3;

/// Whether the points (3×#points) [length] span a plane or more, so that where they go shows how
/// they turn. Points on a line and a single point do not, nor do points whose extent across the
/// line that fits them best is less than `flat` times that along it.
bool spans_a_plane(const Eigen::Matrix3Xd& points, double flat = kFlat);

}  // namespace deformlab
