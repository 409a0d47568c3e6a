#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace deformlab {

/// An 8-bit sRGB picture of three bytes for each pixel, in rows from the top down. A new image is
/// white.
struct Image {
  Image() = default;
  Image(int width, int height);  ///< throws InputError outside 1..32767 [pixel]

  std::uint8_t* pixel(int x, int y) { return rgb.data() + offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgb.data() + offset(x, y); }

  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

 private:
  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
};

/// The image with the text centred in a white strip below it. An empty text does not change the
/// image. A text that is too wide gets a smaller font. Throws InputError if the text is not UTF-8,
/// or if the font (DejaVu Sans) is not installed.
Image with_caption(const Image& image, const std::string& text);

/// The images row by row in `columns` columns. Each is centred in a cell that is as wide as the
/// widest of all images and as high as the highest of its row. Throws InputError if there are no
/// images or `columns` is not positive.
Image grid(const std::vector<Image>& images, int columns);

/// The images in one row, each as in `grid`.
Image side_by_side(const std::vector<Image>& images);

/// The images without their white margins, except for a border of `border` pixels. All images are
/// cropped to the same rectangle, so that they can be compared. Images that are all white do not
/// change. Throws InputError if the images differ in size.
std::vector<Image> cropped_alike(const std::vector<Image>& images, int border);

/// Writes a complete PNG or none. Throws InputError if the path cannot be written.
void write_png(const Image& image, const std::filesystem::path& path);

}  // namespace deformlab
