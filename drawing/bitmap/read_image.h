#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drawing/bitmap/bitmap.h"

namespace deformlab {

/// An image of a file, and what the file says about it.
struct ReadImage {
  Bitmap bitmap;
  /// Chunks for a PNG of it: the colour profile and, of a PNG, the resolution and the texts.
  std::string chunks;
  std::vector<std::string> notes;  ///< what the user should know, such as a profile left out
};

/// Reads a PNG, JPEG or WebP image; its first bytes say which it is. The orientation that EXIF data
/// give is applied. A colour profile that is not about red, green and blue is left out. Throws
/// InputError if the file cannot be read completely, is animated, or is larger than a Bitmap may
/// be.
ReadImage read_image(const std::filesystem::path& path);

}  // namespace deformlab
