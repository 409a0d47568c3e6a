#pragma once

#include <filesystem>
#include <string>

#include "drawing/bitmap/bitmap.h"

namespace deformlab {

/// Whether the alpha channel tells what the drawing is: a pixel is at least half transparent.
bool has_transparency(const Bitmap& bitmap);

/// Makes the plain background of a bitmap transparent. Its colour is the median of the border's
/// pixels, per channel; it is plain where at least half of them differ from it by no more than the
/// tolerance (0 … 1, greatest difference of a channel). Background is what such pixels connect to
/// the border, so what the drawing encloses stays. The pixels along it are mixtures of it and of
/// the drawing: their alpha is the share of the drawing, estimated with the neighbour that is least
/// like the background.
///
/// Returns a word for the user. Throws InputError where no background is plain.
std::string remove_background(Bitmap& bitmap, double tolerance, const std::filesystem::path& name);

}  // namespace deformlab
