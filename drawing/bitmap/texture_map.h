#pragma once

#include "drawing/binding.h"
#include "drawing/bitmap/bitmap.h"
#include "drawing/scan.h"

namespace deformlab {

/// Pixels that follow a triangulation by linear texture mapping (Igarashi et al. 2005, section 3).
///
/// Each pixel of the output looks up the texture once at its centre, or several times where the
/// texture shrinks there, bilinearly: at rest, and after a translation by whole pixels, the output
/// is the texture, and the silhouette is as smooth as the texture's alpha. The mesh need not cover
/// the drawing: what it leaves out (the outer half of a smooth rim, and more where the mesh is
/// coarse) is cut into small squares whose corners follow the nearest triangle.
///
/// Where the shape folds over itself, the layers are blended from the nearest to the farthest.
/// Coordinates are pixels of the texture.
class TextureMap {
 public:
  TextureMap(Bitmap texture, Triangulation rest);

  /// The texture deformed, vertices at V (2×#V), as far as `box` shows it. Where triangles overlap,
  /// the one of greatest depth is in front; without depths (size 0, else #F) the later triangle.
  /// The same input gives the same bytes, whatever the number of threads. Throws InputError where a
  /// coordinate is not finite and for a size that a Bitmap cannot have.
  Bitmap draw(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth, const PixelBox& box) const;

  /// The corners of the squares beyond the mesh, and where they are once the vertices are at V.
  const Eigen::Matrix2Xd& rim_at_rest() const { return rim_rest_.V; }
  Eigen::Matrix2Xd rim(const Eigen::Matrix2Xd& V) const { return rim_(V); }

 private:
  Bitmap texture_;
  Triangulation rest_;
  Triangulation rim_rest_;  ///< the squares beyond the mesh, two triangles each
  Binding rim_;             ///< of their corners
};

}  // namespace deformlab
