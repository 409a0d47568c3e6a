#include <zlib.h>

#include <array>

#include "drawing/bitmap/png_chunks.h"
#include "drawing/bitmap/read_image.h"
#include "drawing/vector/read_svg.h"
#include "drawing/vector/svg_names.h"
#include "experiments/subjects/drawing/drawing_scene.h"
#include "geometry/core/files.h"
#include "tests/fuzz/readers.h"
#include "tests/support/drawings.h"
#include "tests/support/images.h"

// Images, vector drawings and polygons.
namespace deformlab::fuzz {
namespace {

using namespace std::string_literals;

void read_image_file(const std::string& bytes) { read_image(put("image", bytes)); }

/// What a run makes of a drawing before it is deformed, with a small picture and a small mesh.
void make_scene(const std::string& name, const std::string& bytes) {
  put(name, bytes);
  DrawingSceneOptions options;
  options.file = name;
  options.reading.outline = 48;
  options.mesh.vertices = 40;
  make_drawing(options, private_folder(), {});
}

std::size_t big_endian(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + std::uint8_t(bytes[i]);
  return value;
}

/// The PNG with right checksums, because a changed chunk would otherwise be refused by its checksum
/// and nothing behind it would ever be tried.
std::string with_right_checksums(std::string bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t size = big_endian(bytes, at);
    if (size > bytes.size() - at - 12) break;
    const auto* data = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    const auto sum = crc32(0, data, static_cast<uInt>(size + 4));
    for (int i = 0; i < 4; ++i) bytes[at + 8 + size + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += 12 + size;
  }
  return bytes;
}

std::string png(const Bitmap& bitmap, const std::string& chunks = "") {
  const std::filesystem::path path = private_folder() / "sample.png";
  write_png(bitmap, path, chunks);
  return read_file(path);
}

Bitmap small_disc() { return test::disc(20, 16, {10, 8}, 6); }

Texts png_samples() {
  const std::string plain = png(test::halves());
  return {png(small_disc()), plain, with_chunks(plain, profile_chunk(test::profile("RGB ")), 1),
          with_chunks(plain, test::chunk("eXIf", test::tiff(6)), 1),
          with_chunks(plain, test::chunk("pHYs", "\0\0\0\1\0\0\0\2\1"s), 1)};
}

Texts png_words() {
  return {"IHDR", "PLTE", "tRNS", "IDAT", "IEND", "iCCP", "eXIf",
          "pHYs", "gAMA", "sRGB", "tEXt", "zTXt", "iTXt", "acTL"};
}

Texts jpeg_samples() {
  const std::string plain = test::jpeg(test::halves());
  const std::string profile = "ICC_PROFILE\0\1\1"s + test::profile("RGB ");
  return {plain, test::oriented(plain, 6), test::with_segment(plain, '\xe2', profile)};
}

Texts webp_samples() {
  return {test::webp(small_disc(), test::tiff(6), test::profile("RGB ")),
          test::webp(test::halves(), "Exif\0\0"s + test::tiff(3), test::profile("GRAY"))};
}

std::string svg(const std::string& inside) {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
         "width='40' height='40' viewBox='0 0 40 40'>" +
         inside + "</svg>";
}

Texts svg_samples() {
  return {
      svg("<path fill='red' d='M5 5h20v20H5zM10,10 C1 2 3 4 5 6 S7 8 9 9 Q1 2 3 4 T5 6 a3 2 10 0 1 "
          "4 4z'/><rect x='3' y='3' width='9' height='9' rx='2'/>"),
      svg("<style>.a{fill:#00f;stroke:blue}path{opacity:.5}</style><g class='a' transform='rotate("
          "10) scale(2 1) matrix(1 0 0 1 2 3) skewX(3)'><circle cx='9' cy='9' r='5'/><polygon "
          "points='1,1 9,1 9 9'/></g>"),
      svg("<defs><linearGradient id='g'><stop offset='0' stop-color='red'/><stop offset='50%' "
          "stop-color='rgb(1,2,3)' stop-opacity='.5'/></linearGradient><clipPath id='c'><rect "
          "width='20' height='20'/></clipPath><path id='p' d='M2 2L20 2L9 19z'/></defs><use "
          "xlink:href='#p' fill='url(#g)' clip-path='url(#c)' x='3'/>"),
      svg("<marker id='m' markerWidth='5' markerHeight='5'><path d='M0 0h3v3z'/></marker><path "
          "d='M3 3L20 20L30 5' stroke='black' stroke-width='2' stroke-dasharray='3 1' "
          "marker-mid='url(#m)' fill='none'/><text x='9' y='30'>a</text>"),
      svg("<filter id='f'><feGaussianBlur stdDeviation='1'/></filter><mask id='k'><circle r='9'/>"
          "</mask><ellipse cx='20' cy='20' rx='9' ry='5' style='mix-blend-mode:multiply;"
          "filter:url(#f);mask:url(#k)'/><rect width='30' height='30' fill='#123'/>")};
}

Texts svg_words() {
  return {"<svg ",
          "<path d='",
          "<g ",
          "<use ",
          "xlink:href='#",
          "<style>",
          "</style>",
          "<defs>",
          "</defs>",
          "<marker id='",
          "<clipPath ",
          "<mask ",
          "<pattern ",
          "<symbol ",
          "<image ",
          "<text>",
          "<switch>",
          "<stop offset=",
          "url(#",
          "transform='",
          "matrix(",
          "rotate(",
          "scale(",
          "translate(",
          "skewX(",
          "style='",
          "class='",
          "id='",
          "viewBox='",
          "preserveAspectRatio='",
          "fill-rule",
          "evenodd",
          "stroke-width",
          "stroke-dash",
          "mix-blend-mode:",
          "opacity",
          "clip-path=",
          "display:none",
          "inherit",
          "currentColor",
          "<!DOCTYPE [",
          "<!ENTITY ",
          "<![CDATA[",
          "&#0;",
          "1e38",
          "<radialGrad",
          "gradientUn",
          "userSpaceOnUse",
          "marker-mid:",
          "@import",
          "</g>",
          "</svg>",
          "%",
          "mm",
          "NaN"};
}

Texts polygon_samples() { return {"0 0\n10 0\n10 10\n0 10\n", "# a triangle\n0 0\n4 0\n1 3e0\n"}; }

Texts image_samples() { return {png(small_disc()), test::jpeg(test::disc(9, 9, {4, 4}, 3))}; }

}  // namespace

std::vector<Reader> drawing_readers() {
  return {
      {"png", [](const std::string& bytes) { read_image_file(with_right_checksums(bytes)); },
       png_samples, png_words},
      {"jpeg", read_image_file, jpeg_samples,
       [] {
         return Texts{"\xff\xd8", "\xff\xe1", "\xff\xe2", "Exif\0\0"s, "ICC_PROFILE\0"s};
       }},
      {"webp", read_image_file, webp_samples,
       [] { return Texts{"RIFF", "WEBP", "VP8 ", "VP8L", "VP8X", "ICCP", "EXIF", "ALPH"}; }},
      {"image_drawing",
       [](const std::string& bytes) { make_scene("image.png", with_right_checksums(bytes)); },
       image_samples, png_words},
      {"svg", [](const std::string& bytes) { read_svg(bytes, "drawing.svg"); }, svg_samples,
       svg_words},
      {"svg_names", [](const std::string& bytes) { const SvgNames names(bytes, "drawing.svg"); },
       svg_samples, svg_words},
      {"svg_drawing", [](const std::string& bytes) { make_scene("drawing.svg", bytes); },
       svg_samples, svg_words},
      {"polygon", [](const std::string& bytes) { make_scene("polygon.txt", bytes); },
       polygon_samples, [] { return Texts{"#", "nan", "1e50", "1e-50", "-", "\n"}; }}};
}

}  // namespace deformlab::fuzz
