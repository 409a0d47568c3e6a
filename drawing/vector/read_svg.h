#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// What an SVG paints, in the order in which it does.
struct VectorDrawing {
  double width = 0, height = 0;  ///< of the page [pixel]
  std::vector<VectorPath> paths;
  std::vector<std::string> notes;  ///< what was left out or painted otherwise
};

/// Reads an SVG: all paths and shapes, with their transformations, style sheets, colours,
/// gradients, strokes, dashes, clips and references within the file. Arcs become cubics. A group's
/// opacity is given to each of its objects, a pattern becomes the colour of its first object, and a
/// stroke that is stretched more along one direction gets the mean width. Text, images, filters and
/// masks are left out. Nothing but this file is ever opened.
///
/// Throws InputError where the file is no SVG, paints no path, or its page is empty or too large.
VectorDrawing read_svg(const std::filesystem::path& path);

}  // namespace deformlab
