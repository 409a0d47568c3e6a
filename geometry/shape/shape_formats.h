#pragma once

// What the readers and writers of the single formats share; shape_io.h is for everybody else.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab::formats {

/// Where a file holds one number.
struct Number {
  std::size_t at = 0;      ///< first byte
  std::size_t size = 0;    ///< in bytes
  bool is_single = false;  ///< float32, as a binary number or as what a text file declares
};

/// A piece of a file.
struct Span {
  std::size_t at = 0, size = 0;
};

enum class Encoding { kText, kLittleEndian, kBigEndian };

/// Where a file holds the numbers that a deformation changes.
struct Layout {
  Encoding encoding = Encoding::kText;
  std::vector<Number> positions;    ///< three for each vertex (STL: for each corner)
  std::vector<Number> normals;      ///< three for each vertex (STL: for each facet), or none
  std::vector<Span> normal_traces;  ///< all that has to go for the file to have no normals
};

/// A file whose structure was found to be sound.
struct Scan {
  std::size_t vertices = 0, faces = 0;  ///< how many CGAL has to find (STL: vertices unknown)
  Layout layout;
  std::string plain;  ///< the same points and faces in the same format, without all else
};

/// Each throws InputError where the bytes end too early or are not what the format asks for.
/// CGAL's readers stop silently at such places, or loop, so they get only what passed a scan.
Scan scan_off(std::string_view bytes, const std::string& name);
Scan scan_obj(std::string_view bytes, const std::string& name);
Scan scan_ply(std::string_view bytes, const std::string& name);
Scan scan_stl(std::string_view bytes, const std::string& name);
Scan scan_xyz(std::string_view bytes, const std::string& name);

/// The shape in a file of its own.
std::string print_off(const Shape& shape);
std::string print_obj(const Shape& shape);
std::string print_ply(const Shape& shape);
std::string print_stl(const Shape& shape);
std::string print_xyz(const Shape& shape);

/// A copy of an STL file with other positions, and the normals of its facets made anew. Throws
/// InputError where the shape has another number of triangles.
std::string rewrite_stl(std::string_view bytes, const Layout& layout, const Shape& shape);

/// Points and faces of a plain file, by CGAL; false where CGAL could not read it.
bool parse_off(const std::string& plain, Shape& shape);
bool parse_obj(const std::string& plain, Shape& shape);
bool parse_ply(const std::string& plain, Shape& shape);
bool parse_stl(const std::string& plain, Shape& shape);
bool parse_xyz(const std::string& plain, Shape& shape);

}  // namespace deformlab::formats
