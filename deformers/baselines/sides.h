#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// A side of a triangle, from its k-th corner to the next.
struct Side {
  int low, high;  ///< its vertices, low < high
  int triangle, k;
  bool upward;  ///< whether it leads from the lower vertex to the higher

  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// All sides of the triangles T (3×#T vertices), sorted by (low, high, triangle): the sides at one
/// edge are next to each other.
std::vector<Side> sorted_sides(const Eigen::Matrix3Xi& T);

}  // namespace deformlab
