#pragma once

#include <Eigen/Geometry>

#include "drawing/binding.h"
#include "drawing/vector/vector_path.h"

namespace deformlab {

/// Paths whose control points follow a triangulation (Igarashi et al. 2005, section 3): curves stay
/// curves. A gradient's points do the same where they lie inside the mesh; else they move by the
/// affine map that fits the path's own points best. Widths of strokes and dashes stay.
class BoundPaths {
 public:
  BoundPaths(std::vector<VectorPath> paths, const Triangulation& rest, const Locator& locator);

  const std::vector<VectorPath>& rest() const { return rest_; }
  std::vector<VectorPath> operator()(const Eigen::Matrix2Xd& V) const;

 private:
  std::vector<VectorPath> rest_;
  Binding points_;  ///< path by path: outlines, clips, fill, stroke
};

/// The affine map that takes columns of `from` to those of `to` with the least squares; a
/// similarity where `from` lies on a line, a translation where it is a point.
Eigen::Affine2d fitted_map(const Eigen::Matrix2Xd& from, const Eigen::Matrix2Xd& to);

}  // namespace deformlab
