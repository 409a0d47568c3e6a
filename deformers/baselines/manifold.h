#pragma once

#include <Eigen/Core>
#include <string>

namespace deformlab {

/// Explains why triangles are no orientable manifold with boundary. The text names one position. It
/// is empty for a manifold.
///   T  3×#T, three different vertices in each triangle
///   n  the number of vertices
std::string manifold_fault(const Eigen::Matrix3Xi& T, int n);

}  // namespace deformlab
