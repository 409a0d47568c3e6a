#pragma once

#include <string>

namespace deformlab {

/// What the file of an image says besides its pixels. Members are empty where it says nothing.
struct ImageMetadata {
  std::string exif;     ///< EXIF data, which begin with the header of a TIFF
  std::string profile;  ///< an ICC profile, which tells what the colours mean
};

/// Each takes the bytes of a whole file of its format. What is damaged counts as not there.
ImageMetadata metadata_of_jpeg(const std::string& bytes);
ImageMetadata metadata_of_webp(const std::string& bytes);

/// The orientation that EXIF data give: 1 to 8, where 1 is upright.
int orientation_of(const std::string& exif);

/// Whether an ICC profile is about colours of red, green and blue, as the pixels of a Bitmap are.
bool is_rgb_profile(const std::string& profile);

}  // namespace deformlab
