#pragma once

#include <Eigen/Core>
#include <functional>

#include "geometry/plane/region.h"

namespace deformlab {

/// The length that edges are to have at a place [length].
using Spacing = std::function<double(const Eigen::Vector2d&)>;

/// The region with new corners along its boundary, about `spacing` apart: evenly between sharp
/// corners, which stay, and closer where the boundary would otherwise be left by more than a small
/// part of the spacing, or polygons would meet. Expects a checked region and gives one.
Region resampled(const Region& region, const Spacing& spacing);

}  // namespace deformlab
