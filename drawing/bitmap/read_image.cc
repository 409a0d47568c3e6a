#include "drawing/bitmap/read_image.h"

#include <fmt/format.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include <algorithm>
#include <memory>

#include "drawing/bitmap/image_metadata.h"
#include "drawing/bitmap/png_chunks.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

const std::uint8_t* unsigned_bytes(const std::string& bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

Bitmap bitmap_for(int width, int height, const fs::path& path) {
  const std::string problem = size_problem(width, height);
  if (!problem.empty()) cannot_read(path, fmt::format("it has {}; scale it down", problem));
  return {width, height};
}

bool is_turned(int orientation) { return orientation >= 5 && orientation <= 8; }

/// The upright image. From 5 on, rows and columns are exchanged; 2, 3, 6 and 7 then run from the
/// right, and 3, 4, 7 and 8 from the bottom.
Bitmap upright(Bitmap stored, int orientation) {
  if (orientation < 2 || orientation > 8) return stored;
  const bool turned = is_turned(orientation);
  const bool from_right =
      orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_bottom =
      orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  Bitmap shown(turned ? stored.height : stored.width, turned ? stored.width : stored.height);
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      const int u = from_right ? shown.width - 1 - x : x;
      const int v = from_bottom ? shown.height - 1 - y : y;
      std::copy_n(turned ? stored.pixel(v, u) : stored.pixel(u, v), 4, shown.pixel(x, y));
    }
  return shown;
}

Bitmap read_jpeg(const std::string& bytes, const fs::path& path) {
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, sampling = 0, space = 0;
  if (tjDecompressHeader3(decoder.get(), unsigned_bytes(bytes), bytes.size(), &width, &height,
                          &sampling, &space) != 0)
    cannot_read(path, tjGetErrorStr2(decoder.get()));
  if (space == TJCS_CMYK || space == TJCS_YCCK)
    cannot_read(path, "its colours are CMYK; save it with RGB colours");
  Bitmap bitmap = bitmap_for(width, height, path);
  if (tjDecompress2(decoder.get(), unsigned_bytes(bytes), bytes.size(), bitmap.rgba.data(), width,
                    0, height, TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING) != 0)
    cannot_read(path, fmt::format("{}; the file is damaged", tjGetErrorStr2(decoder.get())));
  return bitmap;
}

Bitmap read_webp(const std::string& bytes, const fs::path& path) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(unsigned_bytes(bytes), bytes.size(), &features) != VP8_STATUS_OK)
    cannot_read(path, "the file is damaged, or it is not a WebP image");
  if (features.has_animation != 0) cannot_read(path, "it is animated; save one of its frames");
  Bitmap bitmap = bitmap_for(features.width, features.height, path);
  if (!WebPDecodeRGBAInto(unsigned_bytes(bytes), bytes.size(), bitmap.rgba.data(),
                          bitmap.rgba.size(), 4 * features.width))
    cannot_read(path, "the file is damaged");
  return bitmap;
}

}  // namespace

ReadImage read_image(const fs::path& path) {
  const std::string bytes = read_file(path);
  const bool is_jpeg = bytes.starts_with("\xff\xd8");
  const bool is_png = bytes.starts_with("\x89PNG");
  const bool is_webp =
      bytes.starts_with("RIFF") && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP";
  if (!is_jpeg && !is_webp && !is_png)
    cannot_read(path, "its bytes are not those of a PNG, JPEG or WebP image; save it as one");
  const ImageMetadata metadata = is_jpeg ? metadata_of_jpeg(bytes)
                                 : is_webp
                                     ? metadata_of_webp(bytes)
                                     : ImageMetadata{exif_of_png(bytes), profile_of_png(bytes)};
  const int orientation = orientation_of(metadata.exif);
  ReadImage image;
  image.bitmap = upright(is_jpeg   ? read_jpeg(bytes, path)
                         : is_webp ? read_webp(bytes, path)
                                   : read_png(path),
                         orientation);
  image.chunks = kept_chunks(bytes, is_turned(orientation));
  if (metadata.profile.empty()) return image;
  if (!is_rgb_profile(metadata.profile)) {
    image.chunks = without_profile(image.chunks);
    image.notes.emplace_back("left out: its colour profile, which is not for red, green and blue");
  } else if (is_jpeg || is_webp) {
    image.chunks = profile_chunk(metadata.profile);
  }
  return image;
}

}  // namespace deformlab
