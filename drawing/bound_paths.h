#pragma once

#include <Eigen/Geometry>

#include "drawing/binding.h"
#include "drawing/bitmap/cut_lines.h"
#include "drawing/vector/vector_path.h"

namespace deformlab {

/// Paths whose control points follow a triangulation (Igarashi et al. 2005, section 3), so that
/// curves stay curves. A gradient moves by the affine map that fits the points of its path best, so
/// that paths that share a gradient and move differently each take theirs along. Strokes and dashes
/// keep their widths and lengths.
class BoundPaths {
 public:
  /// Points on the cuts follow what lies on their own side (places_beside).
  BoundPaths(std::vector<VectorPath> paths, const Triangulation& rest, const Locator& locator,
             const CutLines& cuts = {});

  const std::vector<VectorPath>& rest() const { return rest_; }
  std::vector<VectorPath> operator()(const Eigen::Matrix2Xd& V) const;

 private:
  std::vector<VectorPath> rest_;
  Binding points_;  ///< path by path: outlines, clips
};

/// The affine map that fits the columns of `from` to those of `to` by least squares. It is a
/// similarity if `from` lies on a line, and a translation if it is a single point.
Eigen::Affine2d fitted_map(const Eigen::Matrix2Xd& from, const Eigen::Matrix2Xd& to);

}  // namespace deformlab
