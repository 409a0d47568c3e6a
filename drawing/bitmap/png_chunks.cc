#include "drawing/bitmap/png_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace deformlab {
namespace {

constexpr std::size_t kSignature = 8;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

std::string bytes_of(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

/// A chunk with its length, name and checksum.
struct Chunk {
  std::string_view all;

  std::string_view name() const { return all.substr(4, 4); }
  std::string_view data() const { return all.substr(8, all.size() - 12); }
};

/// The chunks up to the first one that is damaged.
std::vector<Chunk> chunks_of(std::string_view bytes) {
  std::vector<Chunk> chunks;
  while (bytes.size() >= 12) {
    const std::size_t length = number_at(bytes, 0);
    if (length > bytes.size() - 12) break;
    if (checksum(bytes.substr(4, length + 4)) != number_at(bytes, length + 8)) break;
    chunks.push_back({bytes.substr(0, length + 12)});
    bytes.remove_prefix(length + 12);
  }
  return chunks;
}

bool is_kept(std::string_view name) {
  return name == "iCCP" || name == "pHYs" || name == "tEXt" || name == "zTXt" || name == "iTXt";
}

/// A pHYs chunk for pixels that are smaller by `scale`.
std::string scaled(const Chunk& resolution, double scale) {
  const std::string_view data = resolution.data();
  if (data.size() != 9) return "";
  std::string body = "pHYs";
  for (const std::size_t at : {std::size_t{0}, std::size_t{4}}) {
    const double density = std::round(number_at(data, at) * scale);
    body += bytes_of(static_cast<std::uint32_t>(std::clamp(density, 1.0, 2147483647.0)));
  }
  body += data[8];
  return bytes_of(9) + body + bytes_of(checksum(body));
}

}  // namespace

std::string kept_chunks(const std::string& png) {
  std::string kept;
  if (!png.starts_with("\x89PNG") || png.size() < kSignature) return kept;
  for (const Chunk& chunk : chunks_of(std::string_view(png).substr(kSignature)))
    if (is_kept(chunk.name())) kept += chunk.all;
  return kept;
}

std::string with_chunks(const std::string& png, const std::string& chunks, double scale) {
  const std::vector<Chunk> added = chunks_of(chunks);
  const bool profile =
      std::ranges::any_of(added, [](const Chunk& c) { return c.name() == "iCCP"; });
  std::string result = png.substr(0, kSignature);
  for (const Chunk& chunk : chunks_of(std::string_view(png).substr(kSignature))) {
    const std::string_view name = chunk.name();
    if (profile && (name == "sRGB" || name == "gAMA" || name == "cHRM")) continue;
    result += chunk.all;
    if (name != "IHDR") continue;
    for (const Chunk& other : added)
      result += other.name() == "pHYs" ? scaled(other, scale) : std::string(other.all);
  }
  return result;
}

}  // namespace deformlab
