#pragma once

#include <Eigen/Core>
#include <functional>

#include "geometry/plane/region.h"

namespace deformlab {

/// The desired length of edges at a point [length].
using Spacing = std::function<double(const Eigen::Vector2d&)>;

/// The region with new corners on its boundary, about `spacing` apart. Sharp corners stay, and the
/// new corners are spaced evenly between them. They are closer where an edge would otherwise leave
/// the boundary by more than a small part of the spacing, or where polygons would meet. Expects a
/// checked region and returns one.
Region resampled(const Region& region, const Spacing& spacing);

}  // namespace deformlab
