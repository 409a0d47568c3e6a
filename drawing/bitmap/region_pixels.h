#pragma once

#include <functional>

#include "drawing/bitmap/bitmap.h"
#include "geometry/plane/region.h"

namespace deformlab {

/// Calls visit(x, y) for each pixel whose centre lies in the region (even-odd over its polygons),
/// in rows from the top down.
void for_each_pixel_inside(const Region& region, int width, int height,
                           const std::function<void(int x, int y)>& visit);

/// Makes all pixels transparent that do not belong to the region. A pixel outside the region whose
/// opacity is at least `threshold` (0 … 1) belongs to another part. A fainter pixel belongs to the
/// nearest part that it is connected to.
void clear_outside(const Region& region, double threshold, Bitmap& bitmap);

}  // namespace deformlab
