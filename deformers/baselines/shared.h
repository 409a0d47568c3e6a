#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "geometry/handles.h"
#include "geometry/shape.h"

/// What the methods to compare with have in common.
namespace deformlab::baselines {

/// Throws InputError where a handle is no vertex, which `method` cannot take.
void refuse_points(const Handles& handles, const std::string& method);

/// The triangles of a shape (3×#T), each of three different vertices; others are left out.
/// Throws InputError where there are none, which `method` cannot do without.
Eigen::Matrix3Xi proper_triangles(const Shape& shape, const std::string& method);

/// The connected component of each of n things, numbered in the order of their first members.
std::vector<int> components(int n, const std::vector<std::pair<int, int>>& links);

}  // namespace deformlab::baselines
