#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace deformlab {

/// An SVG reduced to the few elements that Cairo writes: paths of straight lines and cubics,
/// colours and gradients by value, matrices, clips, and groups with an opacity. librsvg reads the
/// file and Cairo writes what librsvg paints, so that style sheets, shapes, arcs, units, references
/// and inheritance mean the same as in any viewer.
struct NormalizedSvg {
  std::string text;
  double width = 0, height = 0;    ///< of the page [pixel]
  double scale = 1;                ///< units of `text` per pixel
  std::vector<std::string> notes;  ///< what the text leaves out
};

/// Only `bytes` are read: references to other files, also those of entities, are not followed.
/// Text, images, filters and masks are left out. Throws InputError if the XML cannot be read, or if
/// the page has no extent or more than a million pixels along a side.
NormalizedSvg normalized_svg(const std::string& bytes, const std::filesystem::path& name);

}  // namespace deformlab
