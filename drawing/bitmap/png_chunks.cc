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

std::string made(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  return bytes_of(static_cast<std::uint32_t>(data.size())) + body + bytes_of(checksum(body));
}

/// A pHYs chunk for pixels that are smaller by `scale`.
std::string scaled(const Chunk& resolution, double scale) {
  const std::string_view data = resolution.data();
  if (data.size() != 9) return "";
  std::string densities;
  for (const std::size_t at : {std::size_t{0}, std::size_t{4}}) {
    const double density = std::round(number_at(data, at) * scale);
    densities += bytes_of(static_cast<std::uint32_t>(std::clamp(density, 1.0, 2147483647.0)));
  }
  return made("pHYs", densities + data[8]);
}

/// A pHYs chunk for rows that become columns.
std::string turned_around(const Chunk& resolution) {
  const std::string data(resolution.data());
  return data.size() == 9 ? made("pHYs", data.substr(4, 4) + data.substr(0, 4) + data[8]) : "";
}

/// The data of the first chunk with this name.
std::string data_of(const std::string& png, std::string_view name) {
  if (!png.starts_with("\x89PNG") || png.size() < kSignature) return "";
  for (const Chunk& chunk : chunks_of(std::string_view(png).substr(kSignature)))
    if (chunk.name() == name) return std::string(chunk.data());
  return "";
}

}  // namespace

std::string kept_chunks(const std::string& png, bool turned) {
  std::string kept;
  if (!png.starts_with("\x89PNG") || png.size() < kSignature) return kept;
  for (const Chunk& chunk : chunks_of(std::string_view(png).substr(kSignature))) {
    if (!is_kept(chunk.name())) continue;
    kept += turned && chunk.name() == "pHYs" ? turned_around(chunk) : std::string(chunk.all);
  }
  return kept;
}

std::string exif_of_png(const std::string& png) { return data_of(png, "eXIf"); }

std::string profile_of_png(const std::string& png) {
  constexpr std::size_t kMost = 1 << 24;  // [byte]; real profiles have at most a few million
  const std::string data = data_of(png, "iCCP");
  const std::size_t name = data.find('\0');
  if (name == data.npos || data.size() < name + 2) return "";
  const std::string_view packed = std::string_view(data).substr(name + 2);
  std::string profile(kMost, '\0');
  uLongf size = kMost;
  if (uncompress(reinterpret_cast<Bytef*>(profile.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK)
    return "";
  profile.resize(size);
  return profile;
}

std::string profile_chunk(const std::string& profile) {
  uLongf size = compressBound(profile.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(profile.data()), profile.size());
  const std::string name_and_method("ICC profile\0\0", 13);
  return made("iCCP", name_and_method + packed.substr(0, size));
}

std::string without_profile(const std::string& chunks) {
  std::string kept;
  for (const Chunk& chunk : chunks_of(chunks))
    if (chunk.name() != "iCCP") kept += chunk.all;
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
