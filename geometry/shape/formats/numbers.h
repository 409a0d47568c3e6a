#pragma once

// Reading and printing the numbers of shape files.

#include <map>
#include <span>

#include "geometry/shape/formats/format.h"

namespace deformlab::formats {

/// A part of a file as messages name it: vertex 3 (counted from 0), line 12.
struct Location {
  const std::string& file;
  std::string_view kind;
  std::size_t index = 0;  ///< counted from 0
  int line = 0;           ///< 0 where lines have no meaning

  /// Throws InputError: cannot read 'FILE': KIND INDEX (counted from 0), line LINE: WHAT.
  [[noreturn]] void reject(const std::string& what) const;
};

/// Which numbers a place of a file may have.
enum class Allowed {
  kFinite,
  kMissing,  ///< also NaN, which says that a point has no position
  kAny       ///< also NaN and infinity, where nothing depends on the number
};

bool is_allowed(double value, Allowed allowed);

/// A normal that is not finite becomes zero, as that of a vertex without a face.
void normalise(Eigen::Ref<Eigen::Vector3d> normal);

/// Appends words that must be allowed numbers. Throws InputError where one is not; then the message
/// names `where`. With `is_single`, the numbers are rounded to float32.
void append(Numbers& to, std::span<const Token> words, const Location& where, Allowed allowed,
            bool is_single = false);

/// Takes V from the layout's positions, and N from its normals where there is one for each vertex.
/// N is normalised; a normal that is not finite becomes the zero vector. Vertices without a
/// position go to `missing`. Throws InputError where a face uses one of them, or where no vertex
/// has a position.
void take_points(ShapeFile& file, const std::string& name);

/// What a file contains that nothing reads, by its name, and how often.
using Leftovers = std::map<std::string, std::size_t, std::less<>>;

/// Adds a note that names all leftovers, if there are any: `what` (NAME, NAME 3 times) `why`.
void note_leftovers(std::vector<std::string>& notes, std::string_view what,
                    const Leftovers& leftovers, std::string_view why);

/// A binary number of four (float32) or eight bytes (float64).
double binary_number(std::string_view bytes, Encoding encoding);

/// Appends the three numbers of column i, separated by blanks, each with the fewest digits that
/// read back as the same number.
void append_column(std::string& to, const Eigen::Matrix3Xd& matrix, Eigen::Index i);

/// Appends a number as the encoding and its precision ask for it. Throws InputError where a float32
/// cannot have the value.
void append_number(std::string& to, double value, bool is_single, Encoding encoding);

/// Appends the four bytes of an unsigned integer, the lowest byte first.
void append_uint32(std::string& to, std::size_t value);

/// The text that takes the place of a part of a file.
struct Edit {
  ByteRange range;
  std::string text;
};

/// A copy of a file with the positions V and the normals N where the layout has normals. Numbers
/// that do not change keep their digits. Where N is 3×0, the normals are removed. V and N have a
/// column for every three numbers of the layout. `edits` are made as well.
std::string substitute(std::string_view bytes, const Layout& layout, const Eigen::Matrix3Xd& V,
                       const Eigen::Matrix3Xd& N, std::vector<Edit> edits = {});

}  // namespace deformlab::formats
