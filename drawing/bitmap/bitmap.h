#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace deformlab {

/// Pixels with straight (not premultiplied) sRGB colour and alpha, in rows from the top down. A new
/// bitmap is transparent.
struct Bitmap {
  Bitmap() = default;
  /// Throws InputError if a side is outside 1..kLargestSide or there are more than kMostPixels.
  Bitmap(int width, int height);

  std::uint8_t* pixel(int x, int y) { return rgba.data() + offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgba.data() + offset(x, y); }

  int width = 0, height = 0;       ///< [pixel]
  std::vector<std::uint8_t> rgba;  ///< four bytes for each pixel

  static constexpr int kLargestSide = 32767;       ///< [pixel]
  static constexpr int kMostPixels = 100'000'000;  ///< 400 MB

 private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
};

/// Why a bitmap cannot have this size, such as `100000×1 pixels: each side …`; empty if it can.
std::string size_problem(double width, double height);

/// The opacity of each pixel, height × width, 0 … 1.
Eigen::ArrayXXf alpha_of(const Bitmap& bitmap);

/// Reads a PNG of any colour type, depth and interlacing. 16 bits are rounded to 8. Throws
/// InputError if the file cannot be read completely, or is larger than a Bitmap may be.
Bitmap read_png(const std::filesystem::path& path);

/// Writes a complete PNG with alpha, or none. `chunks` are those of another PNG that it keeps
/// (`kept_chunks`), whose resolution is multiplied by `scale`. Throws InputError if the path cannot
/// be written.
void write_png(const Bitmap& bitmap, const std::filesystem::path& path,
               const std::string& chunks = "", double scale = 1);

}  // namespace deformlab
