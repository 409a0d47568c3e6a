#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace deformlab {

/// A connected region of the plane. Its polygons are simple and closed; each is 2×n corners, and
/// the first corner is not repeated at the end.
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

/// Whether a point lies in the outline and in no hole.
bool contains(const Region& region, const Eigen::Vector2d& point);

/// The region without repeated corners. Its outline turns from x to y and its holes turn the other
/// way. Throws InputError where a polygon has fewer than three different corners, no area or a
/// coordinate that is not finite, where edges cross or touch (the message names two of them and the
/// point), where a hole is not inside the outline or lies inside another hole, and where the extent
/// or a coordinate is beyond the limits of shape.h. `name` is what the message calls the region.
Region checked(const Region& region, const std::string& name);

/// The region with some of its corners. Its boundary differs by at most about `tolerance` [length],
/// and its polygons stay simple and apart. Expects a checked region.
Region simplified(const Region& region, double tolerance);

}  // namespace deformlab
