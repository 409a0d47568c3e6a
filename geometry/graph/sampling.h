#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Node positions for a deformation graph (Sumner et al. 2007, section 3): points are spread
/// densely over the surface (a point set's own points stand for it), and all within a radius of a
/// randomly chosen one are removed, again and again; the radius is searched so that exactly m
/// remain. Returns 3×m positions [length]; the same seed gives the same nodes. Throws InputError
/// for m < 1 or where the shape has fewer than m distinct points to choose from.
Eigen::Matrix3Xd sample_nodes(const Shape& shape, int m, std::uint64_t seed);

}  // namespace deformlab
