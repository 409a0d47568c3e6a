#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/plane/region.h"

namespace deformlab {

/// The connected parts of the set where a field is at least `threshold`, by marching squares.
/// `field` contains H×W finite numbers. Its entry (row, column) is at x = column + ½, y = row + ½.
/// The field is linear between neighbouring entries, constant from the outermost entries to the
/// border of [0, W] × [0, H], and below any threshold outside. Where only two diagonal corners of a
/// square are at least the threshold, bilinear interpolation decides whether they are connected.
/// Polygons are simple and do not touch, because a crossing stays away from the entries beside it
/// by a thousandth of their distance. Outlines turn from x to y, holes the other way.
std::vector<Region> level_set(const Eigen::ArrayXXf& field, float threshold);

}  // namespace deformlab
