#include "geometry/shape/shape_text.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "geometry/core/error.h"

namespace deformlab::formats {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

template <class Bits>
std::string to_bytes(Bits bits, Encoding encoding) {
  std::string result(sizeof bits, '\0');
  std::memcpy(result.data(), &bits, sizeof bits);
  const bool little = encoding == Encoding::kLittleEndian;
  if (little != (std::endian::native == std::endian::little)) std::ranges::reverse(result);
  return result;
}

template <class Real>
Real from_bytes(std::string_view bytes, Encoding encoding) {
  std::string copy(bytes);
  const bool little = encoding == Encoding::kLittleEndian;
  if (little != (std::endian::native == std::endian::little)) std::ranges::reverse(copy);
  Real result;
  std::memcpy(&result, copy.data(), sizeof result);
  return result;
}

template <class Real>
std::string shortest(Real value) {
  char buffer[40];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// What takes the place of a piece of the source.
struct Edit {
  Span span;
  std::string text;
};

std::string printed(double value, const Number& number, Encoding encoding) {
  if (number.is_single && !std::isfinite(static_cast<float>(value))) {
    throw InputError("cannot write " + shortest(value) + " as float32, which the format asks for");
  }
  if (encoding == Encoding::kText) return digits(value, number.is_single);
  std::string result;
  append_binary(result, value, number.is_single, encoding);
  return result;
}

/// Normals are read normalised, so the file's own digits stay where they mean the same.
void replace(std::vector<Edit>& edits, std::string_view bytes, const std::vector<Number>& numbers,
             Encoding encoding, const Eigen::Matrix3Xd& values, bool normalised) {
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    const std::span<const Number> three(&numbers[static_cast<std::size_t>(3 * i)], 3);
    Eigen::Vector3d old;
    for (int row = 0; row < 3; ++row) old[row] = value_at(bytes, three[row], encoding);
    if (normalised) old.stableNormalize();
    if (old == values.col(i)) continue;
    for (int row = 0; row < 3; ++row) {
      const Number& number = three[row];
      edits.push_back({{number.at, number.size}, printed(values(row, i), number, encoding)});
    }
  }
}

}  // namespace

void reject(const std::string& name, const std::string& what) {
  throw InputError("cannot read '" + name + "': " + what);
}

bool Lines::next() {
  do {
    if (end_ >= bytes_.size()) return false;
    begin_ = end_;
    number_ = next_number_;
    find_end();
    split();
  } while (tokens_.empty());
  return true;
}

void Lines::find_end() {
  bool joined = continued_;
  end_ = begin_;
  do {
    const std::size_t line_break = bytes_.find('\n', end_);
    end_ = std::min(line_break, bytes_.size() - 1) + 1;
    ++next_number_;
    const std::size_t last = bytes_.substr(begin_, end_ - begin_).find_last_not_of("\r\n");
    joined = continued_ && last != std::string_view::npos && bytes_[begin_ + last] == '\\';
  } while (joined && end_ < bytes_.size());
}

void Lines::split() {
  tokens_.clear();
  const std::string blanks = std::string(kBlanks) + (continued_ ? "\\" : "");
  const std::string_view line = bytes_.substr(begin_, end_ - begin_);
  for (std::size_t at = line.find_first_not_of(blanks);
       at != std::string_view::npos && line[at] != '#';) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    tokens_.push_back({begin_ + at, line.substr(at, end - at)});
    at = line.find_first_not_of(blanks, end);
  }
}

std::string Lines::owner(const char* kind, std::size_t index) const {
  std::string text = kind;
  text.append(" ").append(std::to_string(index)).append(" (counted from 0), ");
  return text + number();
}

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "...'" : "'");
}

std::optional<double> to_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return {};
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), {});
  return value;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  return value;
}

double value_at(std::string_view bytes, const Number& number, Encoding encoding) {
  const std::string_view piece = bytes.substr(number.at, number.size);
  if (encoding == Encoding::kText) return to_number(piece).value_or(std::nan(""));
  return number.size == sizeof(float) ? from_bytes<float>(piece, encoding)
                                      : from_bytes<double>(piece, encoding);
}

void append(std::vector<Number>& to, std::span<const Token> words, const std::string& name,
            const std::string& owner, bool is_single) {
  for (const Token& word : words) {
    const std::optional<double> value = to_number(word.text);
    if (!value) reject(name, owner + ": " + quoted(word.text) + " is not a number");
    if (!std::isfinite(is_single ? static_cast<float>(*value) : *value)) {
      reject(name, owner + ": " + quoted(word.text) + " is not finite" +
                       (is_single ? " as float32" : ""));
    }
    to.push_back({word.at, word.text.size(), is_single});
  }
}

std::string digits(double value, bool is_single) {
  return is_single ? shortest(static_cast<float>(value)) : shortest(value);
}

void append_column(std::string& to, const Eigen::Matrix3Xd& matrix, Eigen::Index i) {
  for (int row = 0; row < 3; ++row) {
    if (row > 0) to += ' ';
    to += shortest(matrix(row, i));
  }
}

void append_binary(std::string& to, double value, bool is_single, Encoding encoding) {
  to += is_single ? to_bytes(std::bit_cast<std::uint32_t>(static_cast<float>(value)), encoding)
                  : to_bytes(std::bit_cast<std::uint64_t>(value), encoding);
}

std::string substitute(std::string_view bytes, const Layout& layout, const Eigen::Matrix3Xd& V,
                       const Eigen::Matrix3Xd& N) {
  std::vector<Edit> edits;
  replace(edits, bytes, layout.positions, layout.encoding, V, false);
  if (N.cols() > 0 && !layout.normals.empty()) {
    replace(edits, bytes, layout.normals, layout.encoding, N, true);
  } else {
    for (const Span& span : layout.normal_traces) edits.push_back({span, ""});
  }
  std::ranges::sort(edits, {}, [](const Edit& edit) { return edit.span.at; });
  std::string result;
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    result.append(bytes.substr(at, edit.span.at - at)).append(edit.text);
    at = edit.span.at + edit.span.size;
  }
  return result.append(bytes.substr(at));
}

}  // namespace deformlab::formats
