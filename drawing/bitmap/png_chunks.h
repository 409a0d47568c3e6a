#pragma once

#include <string>

namespace deformlab {

/// The chunks of a PNG that a changed picture keeps, one after the other as they stand in the file:
/// colour profile (iCCP), resolution (pHYs) and texts (tEXt, zTXt, iTXt). Empty for a file that is
/// not a PNG, and where it is damaged.
std::string kept_chunks(const std::string& png);

/// The PNG with these chunks after its header. The resolution is multiplied by `scale`, and the
/// PNG's own colour space gives way to a profile.
std::string with_chunks(const std::string& png, const std::string& chunks, double scale);

}  // namespace deformlab
