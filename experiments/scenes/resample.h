#pragma once

#include "geometry/shape/shape.h"

namespace deformlab {

/// The shape as a triangle mesh of that many vertices: subdivided (Loop's rule) until it has as
/// many, then simplified by collapsing edges, which meets the number as closely as closed parts
/// allow. Throws InputError for a shape that is no manifold mesh, or a number that cannot be met
/// within 1 %.
Shape resampled(const Shape& shape, int vertices);

}  // namespace deformlab
