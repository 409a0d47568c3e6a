#pragma once

#include <Eigen/Core>
#include <memory>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The point of a triangulation that is nearest to a given point.
struct Located {
  int triangle;             ///< column of F
  Eigen::Vector3d b;        ///< its barycentric coordinates in the triangle, ≥ 0, with sum 1
  Eigen::Vector2d nearest;  ///< the given point itself where that is inside [length]
  double distance;          ///< from the given point, 0 inside [length]
};

/// Finds the triangle that contains a point or is nearest to it.
class Locator {
 public:
  /// Copies the triangles. Throws InputError where there are none.
  explicit Locator(const Triangulation& mesh);
  ~Locator();
  Locator(Locator&&) noexcept;

  /// Of several triangles at the same distance it finds the first. Throws InputError where the
  /// point is not finite.
  Located operator()(const Eigen::Vector2d& point) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace deformlab
