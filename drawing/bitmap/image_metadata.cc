#include "drawing/bitmap/image_metadata.h"

#include <libexif/exif-data.h>
#include <webp/demux.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string_view>

namespace deformlab {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kExif = "Exif\0\0"sv, kProfile = "ICC_PROFILE\0"sv;

const std::uint8_t* unsigned_bytes(std::string_view bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

/// Calls visit(marker, data) for each segment of a JPEG before its pixels.
template <class Visit>
void for_each_segment(std::string_view bytes, Visit&& visit) {
  constexpr int kPixels = 0xda, kEnd = 0xd9, kFill = 0xff;
  const auto byte = [&](std::size_t at) { return int{static_cast<std::uint8_t>(bytes[at])}; };
  for (std::size_t at = 2; at + 4 <= bytes.size() && byte(at) == 0xff;) {
    const int marker = byte(at + 1);
    if (marker == kPixels || marker == kEnd) return;
    if (marker == kFill) {
      ++at;
      continue;
    }
    const auto length = static_cast<std::size_t>(byte(at + 2) << 8 | byte(at + 3));
    if (length < 2 || at + 2 + length > bytes.size()) return;
    visit(marker, bytes.substr(at + 4, length - 2));
    at += 2 + length;
  }
}

std::string chunk_of(const WebPDemuxer* file, const char* name) {
  WebPChunkIterator chunk;
  if (WebPDemuxGetChunk(file, name, 1, &chunk) == 0) return "";
  std::string bytes(reinterpret_cast<const char*>(chunk.chunk.bytes), chunk.chunk.size);
  WebPDemuxReleaseChunkIterator(&chunk);
  return bytes;
}

std::string without_exif_header(std::string_view data) {
  return std::string(data.substr(data.starts_with(kExif) ? kExif.size() : 0));
}

}  // namespace

ImageMetadata metadata_of_jpeg(const std::string& bytes) {
  constexpr int kApp1 = 0xe1, kApp2 = 0xe2;
  ImageMetadata metadata;
  std::map<int, std::string_view> parts;  // of the profile, by their numbers from 1 on
  std::size_t count = 0;
  for_each_segment(bytes, [&](int marker, std::string_view data) {
    if (marker == kApp1 && data.starts_with(kExif)) metadata.exif = without_exif_header(data);
    if (marker != kApp2 || !data.starts_with(kProfile) || data.size() < kProfile.size() + 2) return;
    data.remove_prefix(kProfile.size());
    parts[static_cast<std::uint8_t>(data[0])] = data.substr(2);
    count = static_cast<std::uint8_t>(data[1]);
  });
  if (parts.size() != count) return metadata;
  for (const auto& [number, part] : parts) metadata.profile += part;
  return metadata;
}

ImageMetadata metadata_of_webp(const std::string& bytes) {
  const WebPData data{unsigned_bytes(bytes), bytes.size()};
  const std::unique_ptr<WebPDemuxer, decltype(&WebPDemuxDelete)> file(WebPDemux(&data),
                                                                      WebPDemuxDelete);
  if (!file) return {};
  return {without_exif_header(chunk_of(file.get(), "EXIF")), chunk_of(file.get(), "ICCP")};
}

int orientation_of(const std::string& exif) {
  if (exif.empty()) return 1;
  const std::string whole = std::string(kExif) + exif;
  const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(
      exif_data_new_from_data(unsigned_bytes(whole), static_cast<unsigned>(whole.size())),
      exif_data_unref);
  if (!data) return 1;
  const ExifEntry* entry = exif_content_get_entry(data->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 1;
  return exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
}

bool is_rgb_profile(const std::string& profile) {
  constexpr std::size_t kHeader = 128, kColorSpace = 16;
  return profile.size() > kHeader && profile.substr(kColorSpace, 4) == "RGB ";
}

}  // namespace deformlab
