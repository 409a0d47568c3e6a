#pragma once

#include <string>

namespace deformlab {

/// The chunks of a PNG that a changed picture keeps, one after the other as they stand in the file:
/// colour profile (iCCP), resolution (pHYs) and texts (tEXt, zTXt, iTXt). Empty for a file that is
/// not a PNG, and where it is damaged. If the picture is `turned`, so that its rows become columns,
/// the resolutions of both are exchanged.
std::string kept_chunks(const std::string& png, bool turned = false);

/// The EXIF data of a PNG (eXIf), and its colour profile (iCCP), unpacked; empty without one.
std::string exif_of_png(const std::string& png);
std::string profile_of_png(const std::string& png);

/// The chunk iCCP of an ICC profile.
std::string profile_chunk(const std::string& profile);

/// The chunks without the profile.
std::string without_profile(const std::string& chunks);

/// The PNG with these chunks after its header. The resolution is multiplied by `scale`, and the
/// PNG's own colour space gives way to a profile.
std::string with_chunks(const std::string& png, const std::string& chunks, double scale);

}  // namespace deformlab
