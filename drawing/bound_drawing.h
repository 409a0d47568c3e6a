#pragma once

#include <optional>

#include "drawing/bitmap/texture_map.h"
#include "drawing/bound_paths.h"
#include "drawing/drawing.h"
#include "drawing/following_parts.h"

namespace deformlab {

/// A drawing that follows its triangulation. Its detached parts follow it, too (FollowingParts).
class BoundDrawing {
 public:
  /// `parts` are the meshes of the detached parts (meshes_of).
  BoundDrawing(Drawing drawing, Triangulation rest, std::vector<Triangulation> parts = {});

  const Drawing& drawing() const { return drawing_; }
  const Triangulation& rest() const { return rest_; }

  /// The picture of the page with the vertices at V (2×#V), at a resolution [pixel/length]. Where
  /// triangles overlap, the one with the greatest depth (#F) is in front. Without depths (size 0),
  /// curves and the triangles of a bitmap are painted in their own order. The same input gives the
  /// same bytes. Throws InputError if a coordinate is not finite, and for a size that a Bitmap
  /// cannot have.
  Bitmap picture(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth, const Page& page,
                 double resolution) const;

  /// The curves with the vertices at V, in the order in which they are painted. Where triangles
  /// overlap, what belongs to the one with the greatest depth (#F) is in front; without depths
  /// (size 0), the curves keep their order. A bitmap has none.
  std::vector<VectorPath> paths(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth) const;

  /// The page of the drawing, enlarged by whole steps of `step` [length] so that it contains what
  /// is on it at rest. Throws InputError if a coordinate is not finite.
  Page page_for(const Eigen::Matrix2Xd& V, double step) const;

 private:
  /// The picture of the page at rest, for a drawing without a bitmap.
  Bitmap at_rest(double resolution) const;

  Drawing drawing_;
  Triangulation rest_;
  FollowingParts parts_;
  BoundPaths shown_;  ///< without what clips hide. It and texture_ follow the mesh and the parts
  std::optional<TextureMap> texture_;
};

}  // namespace deformlab
