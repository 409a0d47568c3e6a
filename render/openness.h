#pragma once

#include <optional>
#include <vector>

#include "render/surface.h"

namespace deformlab {

/// The openness of what a view shows, measured at every fourth pixel and interpolated between them
/// along the surface. So its cost depends on the size of the picture, not on that of the shape.
class OpennessLattice {
 public:
  /// `width` and `height` are those of the picture [pixel]. The values do not depend on `threads`.
  OpennessLattice(const Surface& surface, const View& view, int width, int height, int threads);

  /// The openness of a point that is seen at (x, y) [pixel], from the picture's top left corner. It
  /// is measured where none of the four points around it lies on the same part of the surface.
  float at(double x, double y, const SurfacePoint& point) const;

 private:
  struct Known {
    SurfacePoint point;
    float openness;
  };
  const std::optional<Known>& known(int column, int row) const {
    return known_[static_cast<std::size_t>(row) * columns_ + column];
  }
  float alikeness(const SurfacePoint& a, const SurfacePoint& b) const;

  const Surface& surface_;
  int columns_, rows_;
  std::vector<std::optional<Known>> known_;
};

}  // namespace deformlab
