#pragma once

#include "drawing/bitmap/bitmap.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// The squares between the centres of neighbouring pixels that contain a part of the drawing which
/// the mesh does not cover, each cut into two triangles. In a drawing with 2,000 pixels or more
/// along a side, a square spans several pixels, so that there are not too many. Coordinates are
/// pixels.
Triangulation uncovered_squares(const Triangulation& mesh, const Bitmap& texture);

}  // namespace deformlab
