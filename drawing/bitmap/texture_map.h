#pragma once

#include "drawing/binding.h"
#include "drawing/bitmap/bitmap.h"
#include "drawing/bitmap/triangle_pixels.h"

namespace deformlab {

/// What a picture of a deformed texture shows.
struct TextureView {
  int width, height;             ///< of the picture [pixel]
  Eigen::Vector2d origin{0, 0};  ///< the place of its upper left corner [texel]
  double scale = 1;              ///< its resolution [pixel/texel]
};

/// Pixels that follow a triangulation by linear texture mapping (Igarashi et al. 2005, section 3).
///
/// The texture is interpolated bilinearly at the centre of each output pixel, or at several points
/// if it shrinks there. If the whole drawing shrinks, a pixel is the mean of what a large picture
/// shows in its place. At rest, and after a translation by whole pixels, the output is the
/// texture. The silhouette is as smooth as the texture's alpha. The mesh need not cover the
/// drawing. The parts outside (half of a smooth boundary, and more if the mesh is coarse) are cut
/// into small squares whose corners follow the nearest triangle (`uncovered_squares`).
///
/// Where the shape overlaps itself, the layers are blended from the nearest to the farthest.
/// Coordinates are pixels of the texture [texel]. The resolution of a picture is no part of the
/// deformation, because what is outside the mesh follows it rigidly and would not shrink.
class TextureMap {
 public:
  TextureMap(Bitmap texture, Triangulation rest);

  /// The part of the deformed texture that `view` shows, with the vertices at V (2×#V) [texel].
  /// Where triangles overlap, the one with the greatest depth (#F) is in front, or the last one
  /// without depths (size 0). The same input gives the same bytes for any number of threads. Throws
  /// InputError if a coordinate is not finite, and for a size that a Bitmap cannot have.
  Bitmap draw(const Eigen::Matrix2Xd& V, const Eigen::VectorXd& depth,
              const TextureView& view) const;

  /// The corners of the squares outside the mesh (2×n) [pixel], at rest and with the vertices at V.
  const Eigen::Matrix2Xd& square_corners_at_rest() const { return squares_.V; }
  Eigen::Matrix2Xd square_corners(const Eigen::Matrix2Xd& V) const { return square_corners_(V); }

 private:
  Bitmap texture_;
  Triangulation rest_;
  Triangulation squares_;   ///< the squares outside the mesh, as two triangles each
  Binding square_corners_;  ///< the corners of the squares
};

}  // namespace deformlab
