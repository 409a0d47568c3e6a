#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// For each vertex, the rotation that best turns the edges around it when the vertices move to V
/// (3×#V): the minimiser of Σ ‖(v'_k − v'_i) − R_i (v_k − v_i)‖². Edges join consecutive corners of
/// faces; a shape without faces has edges to the nearest points instead. A vertex without edges
/// does not turn.
std::vector<Eigen::Matrix3d> local_rotations(const Shape& rest, const Eigen::Matrix3Xd& V);

}  // namespace deformlab
