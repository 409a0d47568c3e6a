#pragma once

#include <Eigen/Core>
#include <string>

namespace deformlab {

/// Why triangles (3×m indices of n vertices, three different ones each) are no orientable manifold
/// with boundary, naming one place where they are not; empty where they are.
std::string manifold_fault(const Eigen::Matrix3Xi& T, int n);

}  // namespace deformlab
