#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"
#include "geometry/shape/weld.h"

namespace deformlab::formats {
namespace {

// A binary file has a header, the number of facets (four bytes), and for each facet twelve float32
// (its normal and three corners) and two bytes of attributes.
constexpr std::size_t kHeaderSize = 80, kBodyAt = 84, kFacetSize = 50, kAttributeSize = 2;

std::size_t facet_count(std::string_view bytes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    count |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[kHeaderSize + i])) << 8 * i;
  }
  return count;
}

Layout read_binary(std::string_view bytes, const std::string& name) {
  Layout layout;
  layout.encoding = Encoding::kLittleEndian;
  const std::size_t facets = facet_count(bytes);
  if (kBodyAt + kFacetSize * facets > bytes.size()) {
    cannot_read(name,
                fmt::format("it is neither text nor whole: as binary STL it announces {} facets, "
                            "which take {} bytes; it has {}",
                            facets, kBodyAt + kFacetSize * facets, bytes.size()));
  }
  layout.normals.values.reserve(3 * facets);
  layout.normals.sources.reserve(3 * facets);
  layout.positions.values.reserve(9 * facets);
  layout.positions.sources.reserve(9 * facets);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    for (std::size_t i = 0; i < 12; ++i) {
      const std::size_t at = kBodyAt + kFacetSize * facet + sizeof(float) * i;
      const double value = binary_number(bytes.substr(at, sizeof(float)), layout.encoding);
      if (i >= 3 && !std::isfinite(value)) {
        cannot_read(name, fmt::format("corner {} of facet {} (counted from 0) is NaN or infinite",
                                      i / 3 - 1, facet));
      }
      Numbers& to = i < 3 ? layout.normals : layout.positions;
      to.values.push_back(value);
      to.sources.push_back({{at, sizeof(float)}, true});
    }
  }
  return layout;
}

class TextReader {
  static constexpr std::array<std::string_view, 5> kOthers = {"solid", "endsolid", "outer",
                                                              "endloop", "color"};

 public:
  TextReader(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {}

  Layout run(std::vector<std::string>& notes) {
    while (lines_.next()) read_line();
    if (keyword_ != "endsolid") {
      cannot_read(name_, "it does not end with endsolid: a part of it is missing");
    }
    if (layout_.normals.values.size() != 3 * facets_) {
      cannot_read(name_, "its last facet has no endfacet");
    }
    if (layout_.positions.values.size() != 9 * facets_) {
      cannot_read(name_, "a vertex stands after its last facet");
    }
    note_leftovers(notes, "lines of unknown kinds", unknown_, "are kept as they are");
    return std::move(layout_);
  }

 private:
  void read_line() {
    const std::span<const Token> words(lines_.tokens());
    const Location where{name_, "facet", facets_, lines_.number()};
    keyword_ = lower_case(words[0].text);
    if (keyword_ == "facet") {
      if (words.size() < 5) where.reject("it needs a normal of 3 numbers");
      append_normal(words.subspan(2, 3), where);
    } else if (keyword_ == "vertex") {
      if (words.size() < 4) where.reject("a vertex needs 3 numbers");
      append(layout_.positions, words.subspan(1, 3), where, Allowed::kFinite);
    } else if (keyword_ == "endfacet") {
      ++facets_;
    } else if (std::ranges::find(kOthers, keyword_) == kOthers.end()) {
      ++unknown_[keyword_];
    }
    check_order(where);
  }

  /// A normal may be NaN, because it is not used.
  void append_normal(std::span<const Token> words, const Location& where) {
    for (const Token& word : words) {
      const std::optional<double> value = to_number(word.text);
      if (!value) where.reject("its normal is not made of numbers");
      layout_.normals.values.push_back(*value);
      layout_.normals.sources.push_back({{word.at, word.text.size()}});
    }
  }

  void check_order(const Location& where) const {
    const bool ends = keyword_ == "endfacet", begins = keyword_ == "facet";
    if ((ends && layout_.positions.values.size() != 9 * facets_) ||
        (begins && layout_.normals.values.size() != 3 * facets_ + 3)) {
      where.reject("a facet must have 3 vertices and an endfacet");
    }
  }

  Lines lines_;
  const std::string& name_;
  Layout layout_;
  std::string keyword_;     ///< of the line that was read last, in lower case
  std::size_t facets_ = 0;  ///< that have ended
  Leftovers unknown_;       ///< the first words of lines that STL does not have
};

/// Makes one vertex of all corners with equal coordinates (0 and −0 are equal). The vertices are
/// numbered in the order of their first corners.
Shape merged(const std::vector<double>& coordinates) {
  const auto corners =
      Eigen::Map<const Eigen::Matrix3Xd>(coordinates.data(), 3, std::ssize(coordinates) / 3);
  std::vector<int> vertex_of = weld(corners), firsts;
  for (int i = 0; i < corners.cols(); ++i) {
    const bool is_new = vertex_of[i] == i;
    vertex_of[i] = is_new ? static_cast<int>(firsts.size()) : vertex_of[vertex_of[i]];
    if (is_new) firsts.push_back(i);
  }
  Shape shape;
  shape.V = corners(Eigen::all, firsts);
  shape.faces.reserve(vertex_of.size() / 3);
  for (auto corner = vertex_of.begin(); corner != vertex_of.end(); corner += 3) {
    shape.faces.emplace_back(corner, corner + 3);
  }
  return shape;
}

/// Whether the file is text. The header of a binary file may say "solid" as well. Such a file is
/// binary where it has the size of one, or a byte 0, which no text has.
bool is_text(std::string_view bytes) {
  const bool exact =
      bytes.size() >= kBodyAt && bytes.size() == kBodyAt + kFacetSize * facet_count(bytes);
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  const std::size_t begin = find_blank(bytes, 0, false);
  return !exact && lower_case(bytes.substr(begin, 5)) == "solid" &&
         bytes.find('\0') == std::string_view::npos;
}

/// The triangles of a shape as STL states them.
struct Facets {
  Eigen::Matrix3Xd corners;  ///< 3×3#T
  Eigen::Matrix3Xd normals;  ///< 3×#T, unit, or zero where the triangle has no area
};

Facets facets_of(const Shape& shape) {
  const Eigen::Matrix3Xi T = triangles(shape);
  Facets facets{Eigen::Matrix3Xd(3, T.size()), Eigen::Matrix3Xd(3, T.cols())};
  for (Eigen::Index t = 0; t < T.cols(); ++t) {
    for (int c = 0; c < 3; ++c) facets.corners.col(3 * t + c) = shape.V.col(T(c, t));
    const Eigen::Vector3d a = facets.corners.col(3 * t);
    facets.normals.col(t) =
        (facets.corners.col(3 * t + 1) - a).cross(facets.corners.col(3 * t + 2) - a);
    facets.normals.col(t).stableNormalize();
  }
  return facets;
}

}  // namespace

ShapeFile read_stl(std::string_view bytes, const std::string& name) {
  ShapeFile file;
  if (is_text(bytes)) {
    file.layout = TextReader(bytes, name).run(file.notes);
  } else {
    if (bytes.size() < kBodyAt) cannot_read(name, "it is too short for an STL file");
    file.layout = read_binary(bytes, name);
    const std::size_t end = kBodyAt + kFacetSize * facet_count(bytes);
    if (end < bytes.size()) {
      file.notes.push_back(
          fmt::format("{} bytes after the last facet are kept as they are", bytes.size() - end));
    }
  }
  file.shape = merged(file.layout.positions.values);
  return file;
}

std::string rewrite_stl(std::string_view bytes, const Layout& layout, const Shape& shape) {
  const Facets facets = facets_of(shape);
  const std::size_t before = layout.normals.values.size() / 3;
  if (before != static_cast<std::size_t>(facets.normals.cols())) {
    throw InputError(fmt::format(
        "cannot write {} triangles in place of the {} facets of the source; write without it",
        facets.normals.cols(), before));
  }
  return substitute(bytes, layout, facets.corners, facets.normals);
}

std::string print_stl(const Shape& shape) {
  const Facets facets = facets_of(shape);
  if (facets.normals.cols() == 0) {
    throw InputError(
        "cannot write as STL: it holds triangles only, and the shape has none; write .off, .obj, "
        ".ply or .xyz instead");
  }
  const auto count = static_cast<std::size_t>(facets.normals.cols());
  std::string bytes(kHeaderSize, '\0');
  bytes.reserve(kBodyAt + kFacetSize * count);
  append_uint32(bytes, count);
  const auto append_point = [&](const auto& point) {
    for (const double x : point) append_number(bytes, x, true, Encoding::kLittleEndian);
  };
  for (Eigen::Index t = 0; t < facets.normals.cols(); ++t) {
    append_point(facets.normals.col(t));
    for (int c = 0; c < 3; ++c) append_point(facets.corners.col(3 * t + c));
    bytes.append(kAttributeSize, '\0');
  }
  return bytes;
}

}  // namespace deformlab::formats
