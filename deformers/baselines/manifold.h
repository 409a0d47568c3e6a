#pragma once

#include <Eigen/Core>
#include <string>

namespace deformlab {

/// Why triangles are no orientable manifold with boundary: a text that names one position where
/// they are not, or an empty one where they are.
///   T  3×#T, three different vertices in each triangle
///   n  the number of vertices
std::string manifold_fault(const Eigen::Matrix3Xi& T, int n);

}  // namespace deformlab
