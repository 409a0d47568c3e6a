#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/shape/handles.h"
#include "geometry/shape/shape.h"

/// This is shared by the baselines that deform surfaces. The argument `method` is the name of the
/// method in messages.
namespace deformlab::baselines {

/// The triangles of a shape.
struct Surface {
  Eigen::Matrix3Xi T;              ///< 3×#T vertices, three different ones in each triangle
  std::vector<int> vertices;       ///< the vertices of these triangles, ascending
  std::vector<std::string> notes;  ///< what a user should know, one sentence each
};

/// Throws InputError for a shape that `check` refuses, and for a shape without triangles.
Surface surface_of(const Shape& shape, const std::string& method);

/// Throws InputError where a handle is a point and no vertex.
void refuse_points(const Handles& handles, const std::string& method);

/// What a user should know about connected components without a handle.
std::string note_on_free_components(int count);

/// Whether the corners of a triangle (3×3, in columns) lie so close to a line or to a point that
/// twice its area is at most `least` times the square of its longest side.
bool is_thin(const Eigen::Matrix3d& corners, double least);

}  // namespace deformlab::baselines
