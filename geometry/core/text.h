#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// UTF-8's byte order mark, which some programs put before a text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Consecutive bytes of a file.
struct ByteRange {
  std::size_t at = 0, size = 0;
};

/// A word of a text file.
struct Token {
  std::size_t at = 0;  ///< the index of its first byte in the file
  std::string_view text;
};

/// Walks over the lines of a text file that contain more than blanks and a comment, which begins
/// with # and ends with the line. A line ends with LF, CR LF, or CR alone. A UTF-8 byte order mark
/// at the begin of the file is skipped.
class Lines {
 public:
  /// With `continued`, a backslash before the end of a line joins the line to the next one. A
  /// comment is never continued.
  explicit Lines(std::string_view bytes, bool continued = false);

  /// Goes to the next such line; returns false at the end of the file.
  bool next();

  const std::vector<Token>& tokens() const { return tokens_; }  ///< at least one
  ByteRange range() const { return {begin_, end_ - begin_}; }   ///< includes the line break
  int number() const { return number_; }                        ///< counted from 1
  std::string name() const { return "line " + std::to_string(number_); }

 private:
  void find_end();
  std::size_t find_break(std::size_t at);
  bool is_joined(std::string_view line) const;
  void split();

  std::string_view bytes_;
  bool continued_;
  std::size_t begin_ = 0, end_ = 0;
  std::size_t line_feed_ = 0, return_ = 0;  // the next ones at or after the line read last
  int number_ = 0, next_number_ = 1;
  std::vector<Token> tokens_;
};

/// Whether a character separates words: a space, a tab, or the end of a line.
constexpr bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The index of the first blank at or after `at`, or of the first character that is no blank where
/// `blank` is false. Returns the text's size where there is none.
std::size_t find_blank(std::string_view text, std::size_t at, bool blank = true);

/// The word in quotation marks as messages show it: at most 40 bytes, unprintable ones replaced.
std::string quoted_ascii(std::string_view word);

/// The word with ASCII letters in lower case.
std::string lower_case(std::string_view word);

/// The text without white space around it.
std::string_view trimmed(std::string_view text);

/// The number that the whole word states, rounded to the nearest double or float, or nothing where
/// the word is not a number. A number that is too large becomes infinite.
std::optional<double> to_number(std::string_view word);
std::optional<float> to_float(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

}  // namespace deformlab
