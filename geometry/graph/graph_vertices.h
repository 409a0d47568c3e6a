#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// The vertex of V (3×#V, at least one) nearest to each point (3×p).
std::vector<int> nearest_vertices(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& V);

/// The same, but a vertex only once: one that an earlier point has got is left out of the search.
/// Throws InputError for more points than vertices.
std::vector<int> distinct_nearest_vertices(const Eigen::Matrix3Xd& points,
                                           const Eigen::Matrix3Xd& V);

}  // namespace deformlab
