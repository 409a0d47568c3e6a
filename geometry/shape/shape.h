#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace deformlab {

/// A mesh, a polygon soup or a point set. No connectivity is assumed: faces may be missing,
/// repeated, non-manifold and of any size.
struct Shape {
  Eigen::Matrix3Xd V;                   ///< 3×#V positions v_i [length], in the file's order
  Eigen::Matrix3Xd N;                   ///< 3×#V unit normals n_i, or 3×0 where there are none
  std::vector<std::vector<int>> faces;  ///< vertex indices of each polygon; none in a point set
};

/// The extents of a shape [length] for which computations stay in the range of a double.
inline constexpr double kLeastLength = 1e-50, kMostLength = 1e50;

/// Throws InputError where the shape has no vertices, a coordinate is not finite or is beyond
/// ±kMostLength, the extent is neither 0 nor in the range above, a face names a vertex that does
/// not exist, or N is neither empty nor 3×#V. `name` is what the message calls the shape, usually
/// its path.
void check(const Shape& shape, const std::string& name);

/// The vertex indices (3×#T) of the faces cut into triangles, which form a fan around each face's
/// first corner. Faces of fewer than three corners give none. Throws InputError for a face that
/// names a vertex which does not exist, as all functions do that go through triangles.
Eigen::Matrix3Xi triangles(const Shape& shape);

/// 3×#V unit normals: the area-weighted mean of the triangles around each vertex. A vertex without
/// a triangle of positive area gets the zero vector.
Eigen::Matrix3Xd vertex_normals(const Shape& shape);

/// Length of the diagonal of the axis-aligned bounding box [length].
double bounding_box_diagonal(const Eigen::Matrix3Xd& V);

}  // namespace deformlab
