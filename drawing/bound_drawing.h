#pragma once

#include <optional>

#include "drawing/bitmap/texture_map.h"
#include "drawing/bound_paths.h"
#include "drawing/drawing.h"

namespace deformlab {

/// A drawing that follows its triangulation.
class BoundDrawing {
 public:
  BoundDrawing(Drawing drawing, Triangulation rest);

  const Drawing& drawing() const { return drawing_; }
  const Triangulation& rest() const { return rest_; }

  /// What the page shows once the vertices are at V (2×#V), `resolution` pixels a unit of length.
  /// Where triangles overlap, the one of greatest depth (#F) is in front. Without depths (size 0)
  /// curves are painted in their own order, and of a bitmap later triangles over earlier ones. The
  /// same input gives the same bytes. Throws InputError where a coordinate is not finite, and for a
  /// size that a Bitmap cannot have.
  Bitmap picture(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth, const Page& page,
                 double resolution) const;

  /// The curves once the vertices are at V; none of a bitmap.
  std::vector<VectorPath> paths(const Eigen::Matrix2Xd& V) const { return paths_(V); }

  /// The drawing's page and, where what is on it at rest leaves it, as much more on that side, in
  /// whole steps of `step` [length]. Throws InputError where a coordinate is not finite.
  Page page_for(const Eigen::Matrix2Xd& V, double step) const;

 private:
  Drawing drawing_;
  Triangulation rest_;
  BoundPaths paths_;
  std::optional<TextureMap> texture_;
};

}  // namespace deformlab
