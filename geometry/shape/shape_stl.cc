#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "geometry/core/error.h"
#include "geometry/shape/shape_text.h"

namespace deformlab::formats {
namespace {

constexpr std::size_t kHeaderSize = 80, kBodyAt = 84, kFacetSize = 50;

std::size_t facet_count(std::string_view bytes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    count |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[kHeaderSize + i])) << 8 * i;
  }
  return count;
}

Scan scan_binary(std::string_view bytes, const std::string& name) {
  Scan scan;
  scan.layout.encoding = Encoding::kLittleEndian;
  scan.faces = facet_count(bytes);
  if (kBodyAt + kFacetSize * scan.faces > bytes.size()) {
    reject(name, "it is neither text nor whole: as binary STL it announces " +
                     std::to_string(scan.faces) + " facets, which take " +
                     std::to_string(kBodyAt + kFacetSize * scan.faces) + " bytes; it has " +
                     std::to_string(bytes.size()));
  }
  for (std::size_t facet = 0; facet < scan.faces; ++facet) {
    for (std::size_t i = 0; i < 12; ++i) {
      const Number number{kBodyAt + kFacetSize * facet + 4 * i, 4, true};
      if (i >= 3 && !std::isfinite(value_at(bytes, number, Encoding::kLittleEndian))) {
        reject(name, "corner " + std::to_string(i / 3 - 1) + " of facet " + std::to_string(facet) +
                         " (counted from 0) is NaN or infinite");
      }
      (i < 3 ? scan.layout.normals : scan.layout.positions).push_back(number);
    }
  }
  // What CGAL reads must not look like text at its beginning.
  scan.plain = std::string(kHeaderSize, '\0');
  scan.plain += bytes.substr(kHeaderSize, 4 + kFacetSize * scan.faces);
  return scan;
}

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

void read_line(const Lines& lines, Scan& scan, const std::string& name) {
  const std::span<const Token> words(lines.tokens());
  const std::string keyword = lower(words[0].text);
  const std::string owner = lines.owner("facet", scan.faces);
  if (keyword == "facet") {
    if (words.size() < 5) reject(name, owner + ": it needs a normal of 3 numbers");
    for (const Token& word : words.subspan(2, 3)) {
      if (!to_number(word.text)) reject(name, owner + ": its normal is not made of numbers");
      scan.layout.normals.push_back({word.at, word.text.size()});
    }
    scan.plain += "facet\n";
  } else if (keyword == "vertex") {
    if (words.size() < 4) reject(name, owner + ": a vertex needs 3 numbers");
    append(scan.layout.positions, words.subspan(1, 3), name, owner);
    scan.plain += "vertex";
    for (const Token& word : words.subspan(1, 3)) scan.plain.append(" ").append(word.text);
    scan.plain += '\n';
  } else if (keyword == "endfacet") {
    ++scan.faces;
    scan.plain += "endfacet\n";
  }
  if ((keyword == "endfacet" && scan.layout.positions.size() != 9 * scan.faces) ||
      (keyword == "facet" && scan.layout.normals.size() != 3 * scan.faces + 3)) {
    reject(name, owner + ": a facet must have 3 vertices and an endfacet");
  }
}

Scan scan_text(std::string_view bytes, const std::string& name) {
  Scan scan;
  scan.plain = "solid\n";
  std::string last;
  for (Lines lines(bytes); lines.next();) {
    last = lower(lines.tokens()[0].text);
    read_line(lines, scan, name);
  }
  if (last != "endsolid") reject(name, "it does not end with endsolid: a part of it is missing");
  if (scan.layout.normals.size() != 3 * scan.faces) reject(name, "its last facet has no endfacet");
  scan.plain += "endsolid\n";
  return scan;
}

}  // namespace

Scan scan_stl(std::string_view bytes, const std::string& name) {
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const bool says_solid = lower(bytes.substr(begin, 5)) == "solid";
  const bool exact =
      bytes.size() >= kBodyAt && bytes.size() == kBodyAt + kFacetSize * facet_count(bytes);
  if (says_solid && !exact) return scan_text(bytes, name);
  if (bytes.size() < kBodyAt) reject(name, "it is too short for an STL file");
  return scan_binary(bytes, name);
}

std::string rewrite_stl(std::string_view bytes, const Layout& layout, const Shape& shape) {
  const Eigen::Matrix3Xi corners = triangles(shape);
  if (layout.normals.size() != static_cast<std::size_t>(corners.size())) {
    throw InputError("cannot write " + std::to_string(corners.cols()) +
                     " triangles in place of the " + std::to_string(layout.normals.size() / 3) +
                     " facets of the source; write without it");
  }
  Eigen::Matrix3Xd positions(3, corners.size()), normals(3, corners.cols());
  for (Eigen::Index facet = 0; facet < corners.cols(); ++facet) {
    for (int c = 0; c < 3; ++c) positions.col(3 * facet + c) = shape.V.col(corners(c, facet));
    const Eigen::Vector3d a = positions.col(3 * facet);
    normals.col(facet) = (positions.col(3 * facet + 1) - a).cross(positions.col(3 * facet + 2) - a);
    normals.col(facet).stableNormalize();
  }
  return substitute(bytes, layout, positions, normals);
}

std::string print_stl(const Shape& shape) {
  const auto facets = static_cast<std::size_t>(triangles(shape).cols());
  if (facets == 0) {
    throw InputError(
        "cannot write as STL: it holds triangles only, and the shape has none; write .off, .obj, "
        ".ply or .xyz instead");
  }
  std::string blank(kHeaderSize, '\0');
  for (int byte = 0; byte < 4; ++byte) blank += static_cast<char>(facets >> 8 * byte & 0xff);
  blank.resize(kBodyAt + kFacetSize * facets);
  return rewrite_stl(blank, scan_stl(blank, "blank").layout, shape);
}

}  // namespace deformlab::formats
