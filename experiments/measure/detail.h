#pragma once

#include "experiments/measure/measurements.h"

namespace deformlab {

/// How the detail of a surface survives a deformation. The smooth base b of the surface v is what
/// (M + ℓ² C)² b = M² v leaves of it, C the cotangent Laplacian and M the areas of the vertices, at
/// rest; where the surface ends, b = v. The detail v − b is looked at in the frame of the base: its
/// normal and, at right angles to it, the direction of an edge. Means are weighted by the length of
/// the detail at rest.
///   detail_rms             of the deformed surface's detail, in diagonals of the rest shape
///   detail_turn            mean angle between the detail before and after, each in its frame
///   [degree] detail_length_error    mean of | |after| / |before| − 1 |
/// The last two only where there is detail at rest.
///   length  ℓ, the scale below which shape is detail, in diagonals of the rest shape, > 0
/// Nothing for a shape without triangles.
Metrics detail(const Shape& rest, const Shape& deformed, double length);

}  // namespace deformlab
