#pragma once

#include "geometry/shape/shape.h"

namespace deformlab {

/// The shape as a triangle mesh with the given number of vertices. It is subdivided by Loop's rule
/// until it has enough vertices, and then simplified by collapsing edges. Closed parts may prevent
/// the exact number. Throws InputError for a shape that is not a manifold mesh, and for a number
/// that cannot be met within 1 %.
Shape resampled(const Shape& shape, int vertices);

}  // namespace deformlab
