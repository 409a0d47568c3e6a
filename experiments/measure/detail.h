#pragma once

#include "experiments/measure/measurements.h"

namespace deformlab {

/// Measures how the detail of a surface survives a deformation. The smooth base b of the surface v
/// is the solution of (M + ℓ² C)² b = M² v, where C is the cotangent Laplacian and M holds the
/// areas of the vertices, both at rest; at the boundary of the surface, b = v. The detail v − b is
/// expressed in the frame of the base, which is its normal and, at right angles to it, the
/// direction of an edge. Means are weighted by the length of the detail at rest.
///   detail_rms           root mean square of the deformed surface's detail, in diagonals of the
///                        rest shape
///   detail_turn          mean angle between the detail before and after, each in its own frame,
///                        in degrees
///   detail_length_error  mean of | |after| / |before| − 1 |
/// The last two exist only if the rest shape has detail. `length` is ℓ, the positive scale below
/// which shape counts as detail, in diagonals of the rest shape. The result is empty for a shape
/// without triangles.
Metrics detail(const Shape& rest, const Shape& deformed, double length);

}  // namespace deformlab
