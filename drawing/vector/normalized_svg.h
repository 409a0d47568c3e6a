#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drawing/bitmap/bitmap.h"

namespace deformlab {

/// An SVG reduced to the few elements that Cairo writes: paths of straight lines and cubics,
/// colours and gradients by value, matrices, clips, and groups with an opacity. librsvg reads the
/// file and Cairo writes what librsvg paints, so that style sheets, shapes, arcs, units, references
/// and inheritance mean the same as in any viewer.
struct NormalizedSvg {
  std::string text;
  double width = 0, height = 0;         ///< of the page [pixel]
  double scale = 1;                     ///< units of `text` per pixel
  std::vector<std::string> notes;       ///< what no viewer would show, such as other files
  std::vector<std::string> not_curves;  ///< what the text leaves out, such as images
};

/// Only `bytes` are read: references to other files, also those of entities, are not followed.
/// Text, images, filters and masks are left out. Throws InputError if the XML cannot be read, or if
/// the page has no extent or more than a million pixels along a side.
NormalizedSvg normalized_svg(const std::string& bytes, const std::filesystem::path& name);

/// The same for each of the elements with these ids alone, without notes.
std::vector<NormalizedSvg> normalized_elements(const std::string& bytes,
                                               const std::filesystem::path& name,
                                               const std::vector<std::string>& ids);

/// librsvg's own picture of the file, which shows all that the file paints. One pixel of the page
/// becomes `resolution` pixels. Throws InputError as normalized_svg does, and for a size that a
/// Bitmap cannot have.
Bitmap svg_picture(const std::string& bytes, const std::filesystem::path& name, double resolution);

}  // namespace deformlab
