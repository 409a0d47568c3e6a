#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// For each of the positions V (3×#V) [length], the first vertex at exactly the same position.
/// Files often repeat vertices along seams, where texture coordinates or normals change, and this
/// tells which of them are one point of the surface.
std::vector<int> weld(const Eigen::Matrix3Xd& V);

}  // namespace deformlab
