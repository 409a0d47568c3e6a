#pragma once

#include <functional>

#include "geometry/shape/shape.h"

namespace deformlab {

/// The closed surface on which `inside` changes its sign, as quads. `inside` is negative within.
/// The method is naive surface nets on a grid of cubes over a box, whose faces must lie outside.
/// Each cube that the surface passes through has one vertex.
///   low, high  corners of the box [length]
///   cell       length of the edges of a cube [length]
Shape surface_nets(const std::function<double(const Eigen::Vector3d&)>& inside,
                   const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell);

}  // namespace deformlab
