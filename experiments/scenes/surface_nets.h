#pragma once

#include <functional>

#include "geometry/shape/shape.h"

namespace deformlab {

/// A closed surface as quads: where `inside` changes its sign (negative within), by naive surface
/// nets on a grid of cubes over the box, whose own faces must lie outside. One vertex a cube that
/// the surface passes through.
///   low, high  corners of the box; cell  edge of a cube, all [length]
Shape surface_nets(const std::function<double(const Eigen::Vector3d&)>& inside,
                   const Eigen::Vector3d& low, const Eigen::Vector3d& high, double cell);

}  // namespace deformlab
