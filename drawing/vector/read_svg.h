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
  std::vector<std::string> notes;       ///< what no picture shows, such as other files
  std::vector<std::string> not_curves;  ///< what the paths leave out or paint otherwise
};

/// Reads an SVG: all paths and shapes, with their transformations, style sheets, colours,
/// gradients, strokes, dashes, clips and references within the file. Arcs become cubics. Each
/// object gets the opacity of its group, a pattern becomes the colour of its first object, and a
/// stroke that is stretched more along one direction gets the mean width. Text, images, filters and
/// masks are left out, and blend modes are not applied. No other file is opened.
///
/// Throws InputError if the file is no SVG, or if its page is empty or too large.
VectorDrawing read_svg(const std::string& bytes, const std::filesystem::path& name);

/// How many paths read_svg finds for each of the elements with these ids.
std::vector<std::size_t> count_paths(const std::string& bytes, const std::filesystem::path& name,
                                     const std::vector<std::string>& ids);

}  // namespace deformlab
