#pragma once

#include <Eigen/Core>
#include <memory>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// A place inside a triangulation.
struct Located {
  int triangle;             ///< column of F
  Eigen::Vector3d b;        ///< its barycentric coordinates there, ≥ 0 and of sum one
  Eigen::Vector2d nearest;  ///< the place itself, or the nearest that is inside [length]
  double distance;          ///< between the two: 0 inside [length]
};

/// Finds the triangle in which a point lies, or the nearest.
class Locator {
 public:
  explicit Locator(const Triangulation& mesh);  ///< keeps a copy of what it needs
  ~Locator();
  Locator(Locator&&) noexcept;

  Located operator()(const Eigen::Vector2d& point) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace deformlab
