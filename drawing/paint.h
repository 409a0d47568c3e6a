#pragma once

#include <cairo.h>

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "drawing/bitmap/bitmap.h"
#include "drawing/vector/vector_path.h"

namespace deformlab {

/// Paints a path with Cairo's current transformation.
void paint(cairo_t* cairo, const VectorPath& path);

/// What `draw` paints on a transparent bitmap. Cairo's unit is a pixel. Throws InputError for a
/// size that a Bitmap cannot have.
Bitmap painted(int width, int height, const std::function<void(cairo_t*)>& draw);

/// The paths on a transparent page. page.min() is the corner of pixel (0, 0), and `resolution` is
/// in [pixel/length]. Throws InputError for a size that a Bitmap cannot have.
Bitmap rasterized(const std::vector<VectorPath>& paths, const Eigen::AlignedBox2d& page,
                  double resolution);

}  // namespace deformlab
