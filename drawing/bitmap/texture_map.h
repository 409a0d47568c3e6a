#pragma once

#include "drawing/binding.h"
#include "drawing/bitmap/bitmap.h"
#include "drawing/bitmap/triangle_pixels.h"

namespace deformlab {

/// Pixels that follow a triangulation by linear texture mapping (Igarashi et al. 2005, section 3).
///
/// Each pixel of the output looks up the texture once at its centre, or several times where the
/// texture shrinks there, bilinearly: at rest, and after a translation by whole pixels, the output
/// is the texture, and the silhouette is as smooth as the texture's alpha. The mesh need not cover
/// the drawing: the rest (the outer half of a smooth boundary, and more where the mesh is coarse)
/// is cut into small squares whose corners follow the nearest triangle (`uncovered_squares`).
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

  /// The corners of the squares outside the mesh (2×n, pixels), at rest and with the vertices at V.
  const Eigen::Matrix2Xd& square_corners_at_rest() const { return squares_.V; }
  Eigen::Matrix2Xd square_corners(const Eigen::Matrix2Xd& V) const { return square_corners_(V); }

 private:
  Bitmap texture_;
  Triangulation rest_;
  Triangulation squares_;   ///< the squares outside the mesh, two triangles each
  Binding square_corners_;  ///< of the corners of the squares
};

}  // namespace deformlab
