#pragma once

#include <filesystem>
#include <string>

#include "drawing/bitmap/bitmap.h"

namespace deformlab {

/// Whether the extension, in lower case and with its dot, is that of an image that can be read.
bool is_image(const std::string& extension);

/// An image of a file, and what the file says about it.
struct ReadImage {
  Bitmap bitmap;
  /// The chunks of a PNG that tell its colour profile, its resolution and its texts.
  std::string chunks;
};

/// Reads a PNG, JPEG or WebP image; its first bytes say which it is. The orientation that EXIF data
/// of a JPEG give is applied. Throws InputError if the file cannot be read completely, is animated,
/// or is larger than a Bitmap may be.
ReadImage read_image(const std::filesystem::path& path);

}  // namespace deformlab
