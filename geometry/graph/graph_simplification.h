#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Circumradius over twice the inradius: 1 for an equilateral triangle, infinite for one of no
/// area.
double aspect_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// A mesh of m of a shape's vertices.
struct Simplified {
  std::vector<int> vertices;  ///< of the shape, ascending
  Eigen::Matrix3Xi T;         ///< 3×#T corners, vertices of the shape
};

/// The mesh simplified to m vertices (Sumner et al. 2007, section 3): edges collapse into one of
/// their ends, the shortest first, unless that would turn a triangle over or make one of a greater
/// aspect ratio than the given one and than it had. So nodes placed there are vertices, and follow
/// them through an animation. Throws InputError for a ratio below 1, where the shape is no manifold
/// mesh, has too few vertices, or m cannot be reached, saying how far it came.
Simplified simplify(const Shape& shape, int m, double max_aspect_ratio);

}  // namespace deformlab
