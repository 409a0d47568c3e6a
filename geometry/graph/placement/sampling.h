#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Samples the node positions of a deformation graph (Sumner et al. 2007, section 3). Points are
/// spread densely over the surface; a shape without faces gives its own points. Then a point is
/// chosen at random and all others within a radius of it are removed, until no point is left to
/// choose. The radius is searched so that exactly m points remain. Returns 3×m positions [length];
/// the same seed gives the same nodes. With `everything`, vertices without a face are among the
/// points as well, beside a surface. Throws InputError as `check` does, and OptionError ("nodes")
/// for m out of range and where the shape has fewer than m distinct points.
Eigen::Matrix3Xd sample_nodes(const Shape& shape, int m, std::uint64_t seed,
                              bool everything = false);

}  // namespace deformlab
