#pragma once

#include "drawing/bitmap/bitmap.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Squares between the centres of neighbouring pixels, each cut into two triangles: those that hold
/// something of the drawing and that the mesh does not cover. In a drawing of over 2,000 pixels
/// they span several pixels. Coordinates are pixels.
Triangulation squares_beyond(const Triangulation& mesh, const Bitmap& texture);

}  // namespace deformlab
