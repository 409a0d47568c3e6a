#pragma once

// What the readers and writers of the shape formats share. geometry/shape/shape_io.h is for
// everybody else.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/core/text.h"
#include "geometry/shape/shape.h"

namespace deformlab::formats {

enum class Encoding { kText, kLittleEndian, kBigEndian };

/// Where and how a file states one number.
struct Number {
  ByteRange bytes;
  bool is_single = false;  ///< float32, as a binary number or by the declaration of a text file
};

/// Numbers of one kind, in the order of the file. Both arrays have the same size.
struct Numbers {
  std::vector<double> values;   ///< a float32 keeps the value that it has in this precision
  std::vector<Number> sources;  ///< where the file states each of them
};

/// Numbers of the vertices that turn with them: three for a vector, or four for a quaternion
/// (w, x, y, z), for each vertex.
struct Attribute {
  std::size_t size = 3;
  Numbers numbers;
};

/// A corner of a face with a normal of its own, as OBJ has them.
struct CornerNormal {
  std::size_t at = 0;  ///< where the file states the normal's index
  int vertex = 0;      ///< −1: it has no position, in a face of one or two corners
  int normal = 0;      ///< its index, counted from 0
  std::uint8_t digits = 0;
  bool relative = false;  ///< the file counts the index backwards
};

/// The numbers of a file that a deformation changes, and where the file states them.
struct Layout {
  Encoding encoding = Encoding::kText;
  Numbers positions;                     ///< three for each vertex (STL: for each corner)
  Numbers normals;                       ///< three for each vertex (STL: for each facet), or none
  std::vector<ByteRange> normal_traces;  ///< what to remove so that the file has no normals
  std::vector<Attribute> attributes;     ///< what else turns with the vertices
  Numbers shared_normals;                ///< three for each normal that corners name
  std::vector<CornerNormal> corners;     ///< the corners that name a normal
  std::size_t normals_end = 0;           ///< where the line of the last of these normals ends
};

/// A shape together with the layout of the file that it was read from.
struct ShapeFile {
  Shape shape;
  Layout layout;
  /// The vertices of the file that have no position, which scanners write as NaN, in increasing
  /// order. The shape and the layout do not contain them.
  std::vector<int> missing;
  std::vector<std::string> notes;  ///< what the user should know, one sentence each
};

/// Each reads all bytes of a file in one pass; `name` is what messages call the file. They throw
/// InputError where the bytes end too early or do not follow the format. `check` of the shape is
/// left to the caller.
ShapeFile read_off(std::string_view bytes, const std::string& name);
ShapeFile read_obj(std::string_view bytes, const std::string& name);
ShapeFile read_ply(std::string_view bytes, const std::string& name);
ShapeFile read_stl(std::string_view bytes, const std::string& name);
ShapeFile read_xyz(std::string_view bytes, const std::string& name);

/// The bytes of a new file that contains only the shape.
std::string print_off(const Shape& shape);
std::string print_obj(const Shape& shape);
std::string print_ply(const Shape& shape);
std::string print_stl(const Shape& shape);
std::string print_xyz(const Shape& shape);

/// A copy of an STL file with the positions of `shape` and with new normals of its facets. Throws
/// InputError where the shape has another number of triangles than the file.
std::string rewrite_stl(std::string_view bytes, const Layout& layout, const Shape& shape);

}  // namespace deformlab::formats
