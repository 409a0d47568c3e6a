#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace deformlab {

/// Lines with corners (2×n, n ≥ 2) along which a drawing is cut [length].
using CutLines = std::vector<Eigen::Matrix2Xd>;

/// The way to a point from the nearest place between `from` and `to`.
Eigen::Vector2d way_from_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                 const Eigen::Vector2d& point);

/// Clears the opacity of the pixels on the lines, so that what lies on either side is no longer
/// connected. The lines are multiplied by `resolution` [pixel/length]. A cut is about as wide as
/// two pixels. Returns a note for each line that meets nothing.
std::vector<std::string> cut_along(const CutLines& lines, double resolution,
                                   Eigen::ArrayXXf& alpha);

}  // namespace deformlab
