#pragma once

// Numbers and lines of shape files, with the places where they stand.

#include <cstdint>
#include <optional>
#include <span>

#include "geometry/shape/shape_formats.h"

namespace deformlab::formats {

/// Throws InputError: cannot read 'NAME': WHAT.
[[noreturn]] void reject(const std::string& name, const std::string& what);

/// A word of a text file.
struct Token {
  std::size_t at = 0;
  std::string_view text;
};

/// The lines of a text file that hold more than blanks and a comment after #.
class Lines {
 public:
  /// With `continued`, a backslash before the end of a line joins it to the next one.
  explicit Lines(std::string_view bytes, bool continued = false)
      : bytes_(bytes), continued_(continued) {}

  bool next();  ///< steps to the next such line; false at the end of the file

  const std::vector<Token>& tokens() const { return tokens_; }
  Span span() const { return {begin_, end_ - begin_}; }  ///< with its line break
  std::string number() const { return "line " + std::to_string(number_); }
  /// What errors call the thing on this line: face 3 (counted from 0), line 12.
  std::string owner(const char* kind, std::size_t index) const;

 private:
  void find_end();
  void split();

  std::string_view bytes_;
  bool continued_;
  std::size_t begin_ = 0, end_ = 0;
  int number_ = 0, next_number_ = 1;
  std::vector<Token> tokens_;
};

/// The word in quotation marks, fit to be shown: shortened, and without unprintable bytes.
std::string quoted(std::string_view word);

/// The whole word as a number (infinite where it is too large), or nothing.
std::optional<double> to_number(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

/// The number that stands at a place of a file; a binary one of four or eight bytes.
double value_at(std::string_view bytes, const Number& number, Encoding encoding);

/// Appends the places of words that must be finite numbers; `owner` is what errors call them.
void append(std::vector<Number>& to, std::span<const Token> words, const std::string& name,
            const std::string& owner, bool is_single = false);

/// The shortest digits that read back as `value`, or as the nearest float.
std::string digits(double value, bool is_single = false);

/// Appends the digits of a column of a matrix, parted by blanks.
void append_column(std::string& to, const Eigen::Matrix3Xd& matrix, Eigen::Index i);

/// Appends the bytes of a binary number of four or eight bytes.
void append_binary(std::string& to, double value, bool is_single, Encoding encoding);

/// A copy of `bytes` with the positions V, and the normals N where the layout has any. Without N
/// the normals are left out. V and N have a column for every three numbers of the layout.
std::string substitute(std::string_view bytes, const Layout& layout, const Eigen::Matrix3Xd& V,
                       const Eigen::Matrix3Xd& N);

}  // namespace deformlab::formats
