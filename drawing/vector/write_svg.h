#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// Writes paths as an SVG whose page is the given box of their coordinates: curves as cubics,
/// gradients by their frames. Whole or not at all. Throws InputError where it cannot be written.
void write_svg(const std::vector<VectorPath>& paths, const Eigen::AlignedBox2d& page,
               const std::filesystem::path& path);

}  // namespace deformlab
