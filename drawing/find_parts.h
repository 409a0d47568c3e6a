#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "drawing/drawing.h"

namespace deformlab {

/// Traces the parts of a drawing in the opacity of its pixels (height × width, 0 … 1), of which
/// `resolution` are one unit of its length, after it has been cut along `cuts`. Puts them into
/// `drawing`, in pixels, with notes for the user. Returns whether parts are left out. `removed`
/// tells whether a background has been removed. Throws InputError for `path` if nothing is opaque
/// enough.
bool find_parts(Eigen::ArrayXXf alpha, double resolution, bool removed,
                const std::filesystem::path& path, const DrawingOptions& options,
                const CutLines& cuts, Drawing& drawing);

}  // namespace deformlab
