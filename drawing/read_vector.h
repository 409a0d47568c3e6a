#pragma once

#include <filesystem>

#include "drawing/drawing.h"

namespace deformlab {

/// Reads an SVG as read_drawing does.
Drawing read_vector_drawing(const std::filesystem::path& path, const DrawingOptions& options,
                            const CutLines& cuts);

}  // namespace deformlab
