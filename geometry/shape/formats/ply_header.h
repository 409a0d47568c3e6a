#pragma once

#include <cstdint>
#include <optional>

#include "geometry/shape/formats/format.h"

namespace deformlab::formats {

/// How a PLY file states a number.
struct PlyType {
  enum class Kind { kSigned, kUnsigned, kReal } kind = Kind::kReal;
  std::size_t size = 0;  ///< in bytes, where the file is binary
};

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count_type;  ///< the type of a list's length, if the property is a list
  ByteRange line;                     ///< in the header

  /// Whether it is the list of a face's vertices.
  bool has_corners() const {
    return count_type && (name == "vertex_indices" || name == "vertex_index");
  }
};

struct PlyElement {
  std::string name;
  std::uint64_t rows = 0;
  std::vector<PlyProperty> properties;

  bool is_vertex() const { return name == "vertex" || name == "vertices"; }
  bool is_face() const { return name == "face" || name == "faces"; }
};

struct PlyHeader {
  Encoding encoding = Encoding::kText;
  std::vector<PlyElement> elements;
  std::size_t end = 0;  ///< where the body begins
};

/// Throws InputError where the header is incomplete, has unknown types, or lacks what a shape
/// needs: vertices with x, y, z as float or double, and for faces, if there are any, a list of
/// their vertices.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace deformlab::formats
