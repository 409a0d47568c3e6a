#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace deformlab {

/// The handles of each group (Handles::groups), by the groups' numbers. Without groups, each handle
/// is one by itself.
std::vector<std::vector<int>> handle_groups(Eigen::Index handles, std::span<const int> groups);

/// Whether the points (3×#points) [length] span a plane or more, so that where they go shows how
/// they turn. Points on a line and a single point do not.
bool spans_a_plane(const Eigen::Matrix3Xd& points);

}  // namespace deformlab
