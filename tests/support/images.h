#pragma once

#include <turbojpeg.h>
#include <webp/encode.h>
#include <zlib.h>

#include <cstdint>
#include <string>

#include "drawing/bitmap/bitmap.h"

// Image files of all formats that are read, with what such files hold besides their pixels.
namespace deformlab::test {

/// 32 × 16 pixels, of which the left half is red and the right half is blue.
inline Bitmap halves() {
  Bitmap bitmap(32, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      bitmap.pixel(x, y)[x < 16 ? 0 : 2] = 255;
      bitmap.pixel(x, y)[3] = 255;
    }
  }
  return bitmap;
}

inline std::string jpeg(const Bitmap& bitmap) {
  const tjhandle encoder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjCompress2(encoder, bitmap.rgba.data(), bitmap.width, 0, bitmap.height, TJPF_RGBA, &bytes, &size,
              TJSAMP_444, 95, 0);
  std::string result(reinterpret_cast<const char*>(bytes), size);
  tjFree(bytes);
  tjDestroy(encoder);
  return result;
}

/// EXIF data that give an orientation, as they begin with the header of a TIFF.
inline std::string tiff(char orientation) {
  using namespace std::string_literals;
  return "MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0"s + orientation + "\0\0\0\0\0\0"s;
}

/// The JPEG with a segment in front.
inline std::string with_segment(const std::string& jpeg, char marker, const std::string& data) {
  const std::string length{static_cast<char>((data.size() + 2) >> 8),
                           static_cast<char>(data.size() + 2)};
  return jpeg.substr(0, 2) + "\xff" + marker + length + data + jpeg.substr(2);
}

/// The JPEG with EXIF data that give an orientation.
inline std::string oriented(const std::string& jpeg, char orientation) {
  using namespace std::string_literals;
  return with_segment(jpeg, '\xe1', "Exif\0\0"s + tiff(orientation));
}

/// An ICC profile as far as its header goes.
inline std::string profile(const std::string& colors) {
  std::string bytes(400, 'p');
  return bytes.replace(16, 4, colors);
}

inline std::string little_endian(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
  return text;
}

/// A WebP with EXIF data and an ICC profile.
inline std::string webp(const Bitmap& bitmap, const std::string& exif, const std::string& icc) {
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(bitmap.rgba.data(), bitmap.width, bitmap.height,
                                                  4 * bitmap.width, &bytes);
  const std::string plain(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  const auto chunk = [](const std::string& name, const std::string& data) {
    return name + little_endian(data.size(), 4) + data + std::string(data.size() % 2, '\0');
  };
  const std::string head = little_endian(0x38, 4) + little_endian(bitmap.width - 1, 3) +
                           little_endian(bitmap.height - 1, 3);
  const std::string body =
      "WEBP" + chunk("VP8X", head) + chunk("ICCP", icc) + plain.substr(12) + chunk("EXIF", exif);
  return "RIFF" + little_endian(body.size(), 4) + body;
}

/// A chunk of a PNG.
inline std::string chunk(const std::string& name, const std::string& data) {
  const auto big_endian = [](std::size_t value) {
    const std::string text = little_endian(value, 4);
    return std::string(text.rbegin(), text.rend());
  };
  const std::string body = name + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return big_endian(data.size()) + body + big_endian(sum);
}

}  // namespace deformlab::test
