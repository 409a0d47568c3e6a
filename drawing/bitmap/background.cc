#include "drawing/bitmap/background.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "geometry/core/files.h"
#include "geometry/core/median.h"

namespace deformlab {
namespace {

struct Pixel {
  int x, y;
};

std::vector<Pixel> border(const Bitmap& bitmap) {
  std::vector<Pixel> pixels;
  for (int x = 0; x < bitmap.width; ++x) {
    pixels.push_back({x, 0});
    pixels.push_back({x, bitmap.height - 1});
  }
  for (int y = 1; y + 1 < bitmap.height; ++y) {
    pixels.push_back({0, y});
    pixels.push_back({bitmap.width - 1, y});
  }
  return pixels;
}

using Rgb = std::array<std::uint8_t, 3>;

Rgb median_color(const Bitmap& bitmap, const std::vector<Pixel>& pixels) {
  Rgb color{};
  std::vector<std::uint8_t> values(pixels.size());
  for (std::size_t c = 0; c < 3; ++c) {
    std::ranges::transform(pixels, values.begin(),
                           [&](const Pixel& p) { return bitmap.pixel(p.x, p.y)[c]; });
    color[c] = median(values);
  }
  return color;
}

int difference(const std::uint8_t* pixel, const Rgb& color) {
  int most = 0;
  for (std::size_t c = 0; c < 3; ++c)
    most = std::max(most, std::abs(int{pixel[c]} - int{color[c]}));
  return most;
}

/// Makes the pixels transparent that are similar to the colour and connected to the border.
void clear_from_border(Bitmap& bitmap, const std::vector<Pixel>& border_pixels, const Rgb& color,
                       int tolerance) {
  std::vector<Pixel> front;
  const auto take = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= bitmap.width || y >= bitmap.height) return;
    std::uint8_t* pixel = bitmap.pixel(x, y);
    if (pixel[3] == 0 || difference(pixel, color) > tolerance) return;
    std::fill_n(pixel, 4, std::uint8_t{0});
    front.push_back({x, y});
  };
  for (const Pixel& pixel : border_pixels) take(pixel.x, pixel.y);
  while (!front.empty()) {
    const auto [x, y] = front.back();
    front.pop_back();
    take(x + 1, y);
    take(x - 1, y);
    take(x, y + 1);
    take(x, y - 1);
  }
}

template <class Visit>
void neighbours(const Bitmap& bitmap, int x, int y, Visit&& visit) {
  for (int v = std::max(0, y - 1); v <= std::min(bitmap.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(bitmap.width - 1, x + 1); ++u)
      visit(bitmap.pixel(u, v));
}

/// Assumes that the pixel at (x, y) is a·drawing + (1 − a)·background, where the drawing has the
/// colour of the neighbour that differs most from the background. Writes the drawing's colour, with
/// a as its alpha.
void unmix(const Bitmap& from, Bitmap& to, int x, int y, const Rgb& background) {
  const std::uint8_t* pixel = from.pixel(x, y);
  const std::uint8_t* purest = pixel;
  bool beside = false;
  neighbours(from, x, y, [&](const std::uint8_t* other) {
    beside = beside || other[3] == 0;
    if (other[3] != 0 && difference(other, background) > difference(purest, background))
      purest = other;
  });
  if (!beside || purest == pixel) return;
  double along = 0, length = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double way = int{purest[c]} - int{background[c]};
    along += way * (int{pixel[c]} - int{background[c]});
    length += way * way;
  }
  const double a = std::clamp(along / length, 0.0, 1.0);
  std::uint8_t* out = to.pixel(x, y);
  out[3] = static_cast<std::uint8_t>(std::lround(a * pixel[3]));
  if (a == 0) return;
  for (std::size_t c = 0; c < 3; ++c) {
    const double drawing = background[c] + (int{pixel[c]} - int{background[c]}) / a;
    out[c] = static_cast<std::uint8_t>(std::lround(std::clamp(drawing, 0.0, 255.0)));
  }
}

}  // namespace

bool has_transparency(const Bitmap& bitmap) {
  for (std::size_t i = 3; i < bitmap.rgba.size(); i += 4)
    if (bitmap.rgba[i] < 128) return true;
  return false;
}

std::string remove_background(Bitmap& bitmap, double tolerance, const std::filesystem::path& name) {
  const std::vector<Pixel> pixels = border(bitmap);
  const Rgb color = median_color(bitmap, pixels);
  const int most = static_cast<int>(std::lround(255 * tolerance));
  const auto alike = std::ranges::count_if(
      pixels, [&](const Pixel& p) { return difference(bitmap.pixel(p.x, p.y), color) <= most; });
  if (2 * static_cast<std::size_t>(alike) < pixels.size())
    cannot_read(name,
                "every pixel is opaque and the background is not plain: fewer than half of the "
                "border's pixels are of one colour; make the background "
                "transparent, or set drawing.background=none to bend the picture as a rectangle");
  clear_from_border(bitmap, pixels, color, most);
  const Bitmap cleared = bitmap;
  for (int y = 0; y < bitmap.height; ++y)
    for (int x = 0; x < bitmap.width; ++x)
      if (cleared.pixel(x, y)[3] != 0) unmix(cleared, bitmap, x, y, color);
  return fmt::format("took the colour #{:02x}{:02x}{:02x} of the border for the background",
                     color[0], color[1], color[2]);
}

}  // namespace deformlab
