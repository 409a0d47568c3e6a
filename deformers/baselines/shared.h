#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/handles.h"
#include "geometry/shape/shape.h"

/// What the methods to compare with have in common.
namespace deformlab::baselines {

/// Throws InputError where a handle is no vertex, which `method` cannot take.
void refuse_points(const Handles& handles, const std::string& method);

/// A shape as a method for surfaces takes it.
struct Surface {
  Eigen::Matrix3Xi T;              ///< 3×#T, each of three different vertices; others are left out
  std::vector<int> vertices;       ///< that some triangle has, ascending
  std::vector<std::string> notes;  ///< what a user should know, a sentence each
};

/// Throws InputError for a shape that `check` refuses, and where there are no triangles, which
/// `method` cannot do without.
Surface surface_of(const Shape& shape, const std::string& method);

/// The connected component of each of n things, numbered in the order of their first members.
std::vector<int> components(int n, const std::vector<std::pair<int, int>>& links);

}  // namespace deformlab::baselines
