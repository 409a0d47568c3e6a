#pragma once

#include <Eigen/Core>

#include "geometry/shape.h"

namespace deformlab {

/// A region of the plane cut into triangles: the rest shape of a drawing (Igarashi et al. 2005,
/// section 3). Coordinates are those of the drawing, so pixels and y down where it is an image.
struct Triangulation {
  Eigen::Matrix2Xd V;  ///< 2×#V vertices [length]
  Eigen::Matrix3Xi F;  ///< 3×#F corners of each triangle, all turning the same way as (x, y)
};

/// How good triangles are.
struct TriangleQuality {
  double least_angle = 0;  ///< over all triangles [degree]
  double mean = 0;         ///< of 2 r_in / r_out: 1 for equilateral triangles, 0 for slivers
};

TriangleQuality quality(const Triangulation& mesh);

/// The faces of a flat shape, z equal everywhere, cut into triangles; vertices keep their numbers.
/// Throws InputError where the shape is not flat, has no triangle, has a triangle without area or
/// turned over beside its neighbours, or vertices that no triangle has. `name` is what the message
/// calls it.
Triangulation flat(const Shape& shape, const std::string& name);

/// The same with z = 0, for what takes a shape.
Shape to_shape(const Triangulation& mesh);

}  // namespace deformlab
