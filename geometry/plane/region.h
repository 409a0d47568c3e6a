#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace deformlab {

/// A connected region of the plane: simple closed polygons, 2×n corners without the first repeated.
struct Region {
  Eigen::Matrix2Xd outline;             ///< [length]
  std::vector<Eigen::Matrix2Xd> holes;  ///< inside the outline, apart from each other
};

/// Signed area of a closed polygon, positive where it turns from x to y [length²].
double signed_area(const Eigen::Matrix2Xd& polygon);

/// Area of the outline less that of the holes [length²].
double area(const Region& region);

/// Length of the outline and of all holes [length].
double perimeter(const Region& region);

/// The region without repeated corners, the outline turning from x to y and the holes the other
/// way. Throws InputError where a polygon has fewer than three different corners, a coordinate that
/// is not finite, or no area, where edges cross or touch (naming two of them and the place), or
/// where a hole is not inside the outline or lies inside another. `name` is what the message calls
/// the region.
Region checked(const Region& region, const std::string& name);

/// The region with fewer corners, none of which moved; the boundary moves by about `tolerance` at
/// most [length], and polygons stay simple and apart. Expects a checked region.
Region simplified(const Region& region, double tolerance);

}  // namespace deformlab
