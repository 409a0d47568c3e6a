#pragma once

#include <Eigen/Core>

namespace deformlab {

/// The axis, y or z, that most likely points up in a shape with vertices V (3×#V). The stand along
/// an axis is the box around the lowest vertices, as a share of the box around all, both seen along
/// the axis. Up is y if the stand along y is more than twice as wide as that along z and as the one
/// on which the shape would stand upside down; so it is for most figures on their feet. Otherwise
/// it is z.
Eigen::Vector3d upright_axis(const Eigen::Matrix3Xd& V);

}  // namespace deformlab
