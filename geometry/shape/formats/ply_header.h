#pragma once

#include <cstdint>
#include <optional>

#include "geometry/shape/formats/numbers.h"

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
  Leftovers unknown;    ///< the first words of lines that PLY does not have
};

/// The names of properties that make a vector (three) or a quaternion (four, w first) together.
using PlyVector = std::vector<std::string>;

/// Whether the vertices have all these properties as float or double, so that they can turn.
bool has_all(const PlyElement& element, const PlyVector& names);

/// What is known to turn with the vertices, besides their normals: velocities, tangents, the
/// rotations of Gaussian splats.
std::vector<PlyVector> turning_vectors(const PlyElement& element);

/// What the user should know about elements and properties that stay as they are.
std::vector<std::string> notes_of(const PlyHeader& header);

/// Throws InputError where the header is incomplete, has unknown types, or lacks what a shape
/// needs: vertices with x, y, z as float or double, and for faces, if there are any, a list of
/// their vertices.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace deformlab::formats
