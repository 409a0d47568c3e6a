#include "render/image.h"

#include <cairo-ft.h>
#include <cairo.h>
#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <memory>
#include <new>
#include <system_error>

#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr int kLargestSide = 32767;  // the limit of Cairo [pixel]
constexpr double kCaptionHeight = 0.075, kSmallestCaption = 24;
constexpr double kFontSize = 0.58;  // as a part of the caption's height

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Surface to_cairo(const Image& image) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height),
                  cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + std::ptrdiff_t{y} * stride);
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      row[x] = std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

Image from_cairo(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  Image image(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t{y} * stride);
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(row[x] >> (16 - 8 * c));
    }
  }
  return image;
}

void copy(const Image& from, Image& to, int left, int top) {
  for (int y = 0; y < from.height; ++y)
    std::copy_n(from.pixel(0, y), 3 * from.width, to.pixel(left, top + y));
}

cairo_font_face_t* load_font() {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) != 0 || FT_New_Face(library, kFont, 0, &face) != 0)
    throw InputError(fmt::format(
        "cannot set a caption: no font at '{}'; install the package fonts-dejavu-core", kFont));
  return cairo_ft_font_face_create_for_ft_face(face, 0);
}

/// The font is read from its file, because the choice of fontconfig differs between machines. Cairo
/// keeps references to the fonts that it used, so this one lives as long as the process.
cairo_font_face_t* font() {
  static cairo_font_face_t* const face = load_font();
  return face;
}

/// Chooses the font size so that the text fits into `width`. Returns the extents of the text.
cairo_text_extents_t fit_text(cairo_t* cairo, const std::string& text, double size, double width) {
  // Hinting depends on the machine's settings: without it the same text gives the same bytes.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);

  cairo_set_font_face(cairo, font());
  cairo_set_font_size(cairo, size);
  cairo_text_extents_t extents{};
  cairo_text_extents(cairo, text.c_str(), &extents);
  if (extents.width > width) {
    cairo_set_font_size(cairo, size * width / extents.width);
    cairo_text_extents(cairo, text.c_str(), &extents);
  }
  return extents;
}

void draw_text(cairo_t* cairo, const std::string& text, double width, double top, double height) {
  const double size = kFontSize * height;
  const cairo_text_extents_t extents = fit_text(cairo, text, size, 0.96 * width);
  if (cairo_status(cairo) == CAIRO_STATUS_INVALID_STRING)
    throw InputError(fmt::format("cannot draw the caption '{}': it is not UTF-8", text));
  if (cairo_status(cairo) != CAIRO_STATUS_SUCCESS)
    throw InputError(fmt::format("cannot draw the caption '{}': {}", text,
                                 cairo_status_to_string(cairo_status(cairo))));
  cairo_set_source_rgb(cairo, 0.15, 0.15, 0.17);
  cairo_move_to(cairo, (width - extents.width) / 2 - extents.x_bearing,
                top + height / 2 + 0.36 * size);
  cairo_show_text(cairo, text.c_str());
}

struct Bounds {
  int left = kLargestSide, top = kLargestSide, right = -1, bottom = -1;
};

void grow_to_content(const Image& image, Bounds& bounds) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      if (p[0] == 255 && p[1] == 255 && p[2] == 255) continue;
      bounds = {std::min(bounds.left, x), std::min(bounds.top, y), std::max(bounds.right, x),
                std::max(bounds.bottom, y)};
    }
}

}  // namespace

Image::Image(int w, int h) : width(w), height(h) {
  if (w < 1 || h < 1 || w > kLargestSide || h > kLargestSide)
    throw InputError(fmt::format(
        "cannot make an image of {}×{} pixels: each side must lie in 1..{}", w, h, kLargestSide));
  rgb.assign(offset(0, h), 255);
}

Image with_caption(const Image& image, const std::string& text) {
  if (text.empty()) return image;
  const int strip =
      static_cast<int>(std::max(kSmallestCaption, kCaptionHeight * std::min(image.height, 800)));
  Image taller(image.width, image.height + strip);
  copy(image, taller, 0, 0);
  const Surface surface = to_cairo(taller);
  const Context cairo(cairo_create(surface.get()), cairo_destroy);
  draw_text(cairo.get(), text, image.width, image.height, strip);
  return from_cairo(surface.get());
}

Image grid(const std::vector<Image>& images, int columns) {
  if (images.empty() || columns < 1)
    throw InputError(fmt::format("cannot put {} images into {} columns: each must be at least 1",
                                 images.size(), columns));
  const int count = static_cast<int>(images.size());
  columns = std::min(columns, count);
  int width = 0;
  std::vector<int> top{0};  // of each row, and the bottom of the last one
  for (int i = 0; i < count; ++i) {
    const Image& image = images[static_cast<std::size_t>(i)];
    if (i % columns == 0) top.push_back(top.back());
    width = std::max(width, image.width);
    top.back() = std::max(top.back(), *(top.end() - 2) + image.height);
  }
  Image all(columns * width, top.back());
  for (int i = 0; i < count; ++i) {
    const Image& image = images[static_cast<std::size_t>(i)];
    const auto row = static_cast<std::size_t>(i / columns);
    copy(image, all, i % columns * width + (width - image.width) / 2,
         (top[row] + top[row + 1] - image.height) / 2);
  }
  return all;
}

Image side_by_side(const std::vector<Image>& images) {
  return grid(images, std::max(1, static_cast<int>(images.size())));
}

std::vector<Image> cropped_alike(const std::vector<Image>& images, int border) {
  Bounds bounds;
  for (const Image& image : images) {
    if (image.width != images.front().width || image.height != images.front().height)
      throw InputError("cannot crop images of different sizes alike");
    grow_to_content(image, bounds);
  }
  if (bounds.right < 0) return images;
  const int left = std::max(0, bounds.left - border), top = std::max(0, bounds.top - border);
  const int right = std::min(images.front().width - 1, bounds.right + border);
  const int bottom = std::min(images.front().height - 1, bounds.bottom + border);
  std::vector<Image> crops;
  for (const Image& image : images) {
    Image crop(right - left + 1, bottom - top + 1);
    for (int y = 0; y < crop.height; ++y)
      std::copy_n(image.pixel(left, top + y), 3 * crop.width, crop.pixel(0, y));
    crops.push_back(std::move(crop));
  }
  return crops;
}

void write_png(const Image& image, const std::filesystem::path& path) {
  const Surface surface = to_cairo(image);
  std::string bytes;
  const auto append = [](void* to, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    cannot_write(path, cairo_status_to_string(status));
  }
  write_file(path, bytes);
}

}  // namespace deformlab
