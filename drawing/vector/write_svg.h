#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "drawing/vector/svg_names.h"
#include "drawing/vector/vector_path.h"

namespace deformlab {

/// Writes paths as an SVG whose page is the given box of their coordinates. Curves are written as
/// cubics, and gradients with their frames. Paths have the names, groups and links
/// of the elements that they come from. The file is complete, or there is none. Throws
/// InputError if it cannot be written.
void write_svg(const std::vector<VectorPath>& paths, const SvgNames& names,
               const Eigen::AlignedBox2d& page, const std::filesystem::path& path);

}  // namespace deformlab
