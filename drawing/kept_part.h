#pragma once

#include <functional>

#include "drawing/bitmap/bitmap.h"
#include "geometry/plane/region.h"

namespace deformlab {

/// Calls visit(x, y) for each pixel whose centre lies in the region (even-odd over its polygons),
/// in rows from the top down.
void for_each_pixel_inside(const Region& region, int width, int height,
                           const std::function<void(int x, int y)>& visit);

/// Makes what does not belong to the region transparent: the pixels of other parts, those of at
/// least `threshold` opacity outside the region, with the fainter ones around that are nearer to
/// them, and what neither of the two leads to.
void keep_only(const Region& region, double threshold, Bitmap& bitmap);

}  // namespace deformlab
