#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// The circumradius over twice the inradius of a triangle: 1 for an equilateral triangle, infinite
/// for a triangle without area.
double aspect_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// A mesh whose m vertices are vertices of a shape.
struct Simplified {
  std::vector<int> vertices;  ///< m vertices of the shape, ascending
  Eigen::Matrix3Xi T;         ///< 3×#T corners, which are vertices of the shape
};

/// Simplifies a mesh to m vertices (Sumner et al. 2007, section 3). Edges collapse into one of
/// their ends, the shortest edge first, unless a triangle would turn over, or would get an aspect
/// ratio above both `max_aspect_ratio` and its own ratio before. The nodes are therefore vertices
/// of the shape, and follow them through an animation. Throws InputError where the shape is no
/// manifold mesh, and OptionError ("aspect_ratio", "nodes") for a ratio below 1, for m outside of 1
/// … #V, and where m cannot be reached; the message says how far the simplification came.
Simplified simplify(const Shape& shape, int m, double max_aspect_ratio);

}  // namespace deformlab
