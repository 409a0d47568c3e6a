#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// What an SVG paints, in the same order.
struct VectorDrawing {
  double width = 0, height = 0;  ///< of the page [pixel]
  std::vector<VectorPath> paths;
  std::vector<std::string> notes;  ///< what was left out or painted otherwise
};

/// Reads an SVG: all paths and shapes, with their transformations, style sheets, colours,
/// gradients, strokes, dashes, clips and references within the file. Arcs become cubics. Each
/// object gets the opacity of its group, a pattern becomes the colour of its first object, and a
/// stroke that is stretched more along one direction gets the mean width. Text, images, filters and
/// masks are left out. No other file is opened.
///
/// Throws InputError if the file is no SVG or paints no path, or if its page is empty or too large.
VectorDrawing read_svg(const std::filesystem::path& path);

}  // namespace deformlab
