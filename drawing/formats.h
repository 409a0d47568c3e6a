#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace deformlab {

// The extensions of the files of drawings, in lower case. What reads, writes or names them takes
// them from here.
inline constexpr std::array<std::string_view, 4> kImageFormats{".png", ".jpg", ".jpeg", ".webp"};
inline constexpr std::array<std::string_view, 2> kCurveFormats{".svg", ".txt"};
inline constexpr std::array<std::string_view, 4> kFlatMeshFormats{".obj", ".off", ".ply", ".stl"};
inline constexpr std::array<std::string_view, 2> kPictureFormats{".png", ".svg"};  // are written

template <std::size_t n>
constexpr bool is_one_of(const std::array<std::string_view, n>& formats,
                         std::string_view extension) {
  return std::ranges::find(formats, extension) != formats.end();
}

/// All extensions that are read, or that are written, such as `.png, .svg`.
inline std::string formats_read() {
  return fmt::format("{}, {}, {}", fmt::join(kImageFormats, ", "), fmt::join(kCurveFormats, ", "),
                     fmt::join(kFlatMeshFormats, ", "));
}
inline std::string formats_written() {
  return fmt::format("{}, {}", fmt::join(kPictureFormats, ", "), fmt::join(kFlatMeshFormats, ", "));
}

}  // namespace deformlab
