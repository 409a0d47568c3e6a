#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// The vertex of V (3×#V, #V ≥ 1) that is nearest to each of the points (3×p) [length].
std::vector<int> nearest_vertices(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& V);

/// The same, but each vertex is taken once: vertices of earlier points are left out of the search.
/// Throws OptionError ("nodes") for more points than vertices.
std::vector<int> distinct_nearest_vertices(const Eigen::Matrix3Xd& points,
                                           const Eigen::Matrix3Xd& V);

}  // namespace deformlab
