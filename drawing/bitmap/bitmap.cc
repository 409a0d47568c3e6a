#include "drawing/bitmap/bitmap.h"

#include <fmt/format.h>
#include <png.h>

#include <cmath>
#include <memory>

#include "drawing/bitmap/png_chunks.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

using Png = std::unique_ptr<png_image, decltype(&png_image_free)>;

Png make_png(png_image& image) {
  image = {};
  image.version = PNG_IMAGE_VERSION;
  return {&image, png_image_free};
}

std::string cause(const png_image& image) {
  return std::string(image.message) + "; the file is damaged, or it is not a PNG";
}

}  // namespace

Bitmap::Bitmap(int w, int h) : width(w), height(h) {
  const std::string problem = size_problem(w, h);
  if (!problem.empty()) throw InputError("cannot make a bitmap of " + problem);
  rgba.assign(offset(0, h), 0);
}

std::string size_problem(double width, double height) {
  constexpr double kSide = Bitmap::kLargestSide, kMost = Bitmap::kMostPixels;
  const bool fits = width >= 1 && height >= 1 && width <= kSide && height <= kSide;
  if (fits && width * height <= kMost) return "";
  const auto words = [](double side) {
    return std::abs(side) < 1e15 ? fmt::format("{}", static_cast<long>(side)) : "infinitely many";
  };
  return fmt::format(
      "{}×{} pixels: each side must lie in 1..{}, and both give at most {} million pixels",
      words(width), words(height), int{Bitmap::kLargestSide}, Bitmap::kMostPixels / 1'000'000);
}

Eigen::ArrayXXf alpha_of(const Bitmap& bitmap) {
  Eigen::ArrayXXf alpha(bitmap.height, bitmap.width);
  for (int y = 0; y < bitmap.height; ++y)
    for (int x = 0; x < bitmap.width; ++x)
      alpha(y, x) = static_cast<float>(bitmap.pixel(x, y)[3]) / 255;
  return alpha;
}

Bitmap read_png(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  png_image image;
  const Png png = make_png(image);
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
    cannot_read(path, cause(image));
  const std::string problem = size_problem(image.width, image.height);
  if (!problem.empty()) cannot_read(path, "it has " + problem + "; scale it down");
  image.format = PNG_FORMAT_RGBA;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // the meaning of a file without a colour space
  Bitmap bitmap(static_cast<int>(image.width), static_cast<int>(image.height));
  if (!png_image_finish_read(&image, nullptr, bitmap.rgba.data(), 0, nullptr))
    cannot_read(path, cause(image));
  return bitmap;
}

void write_png(const Bitmap& bitmap, const std::filesystem::path& path, const std::string& chunks,
               double scale) {
  png_image image;
  const Png png = make_png(image);
  image.width = static_cast<png_uint_32>(bitmap.width);
  image.height = static_cast<png_uint_32>(bitmap.height);
  image.format = PNG_FORMAT_RGBA;
  const std::uint8_t* pixels = bitmap.rgba.data();
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr))
    cannot_write(path, image.message);
  bytes.resize(size);
  write_file(path, chunks.empty() ? bytes : with_chunks(bytes, chunks, scale));
}

}  // namespace deformlab
