#pragma once

#include <filesystem>
#include <string>

#include "drawing/bitmap/bitmap.h"

namespace deformlab {

/// Whether some pixel is at least half transparent, so that the alpha channel shows the drawing.
bool has_transparency(const Bitmap& bitmap);

/// Makes the plain background of a bitmap transparent. Its colour is the median of the border's
/// pixels, channel by channel. The background is plain if at least half of these pixels differ from
/// its colour by no more than the tolerance (0 … 1) in each channel. Only such pixels that are
/// connected to the border are background, so areas inside the drawing stay. The pixels beside the
/// background mix its colour with the drawing's. Their alpha becomes the share of the drawing,
/// estimated from the neighbour that differs most from the background.
///
/// Returns a note for the user. Throws InputError if the background is not plain.
std::string remove_background(Bitmap& bitmap, double tolerance, const std::filesystem::path& name);

}  // namespace deformlab
