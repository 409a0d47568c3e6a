#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/plane/region.h"

namespace deformlab {

/// The connected parts of where a field is at least `threshold`, by marching squares. `field` is
/// H×W of finite numbers, its entry (row, column) at x = column + ½, y = row + ½; between the
/// entries it is interpolated linearly along the lines through them, from them to the border
/// [0, W] × [0, H] it is constant, and beyond it is below any threshold. Where a square's diagonal
/// corners are at least the threshold and the others below, the bilinear surface between them says
/// what is connected. Polygons are simple and touch nowhere: a crossing keeps a thousandth of the
/// distance from the entries beside it. Outlines turn from x to y, holes the other way.
std::vector<Region> level_set(const Eigen::ArrayXXf& field, float threshold);

}  // namespace deformlab
