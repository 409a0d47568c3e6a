#include "geometry/shape/formats/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab::formats {
namespace {

template <class Real>
using Bytes = std::array<char, sizeof(Real)>;

/// Converts between the machine's byte order and the encoding's.
template <class Real>
void order(Bytes<Real>& bytes, Encoding encoding) {
  const bool little = encoding == Encoding::kLittleEndian;
  if (little != (std::endian::native == std::endian::little)) std::ranges::reverse(bytes);
}

template <class Real>
void append_binary(std::string& to, Real value, Encoding encoding) {
  auto bytes = std::bit_cast<Bytes<Real>>(value);
  order<Real>(bytes, encoding);
  to.append(bytes.data(), bytes.size());
}

template <class Real>
Real from_binary(std::string_view source, Encoding encoding) {
  Bytes<Real> bytes;
  std::ranges::copy(source, bytes.begin());
  order<Real>(bytes, encoding);
  return std::bit_cast<Real>(bytes);
}

template <class Real>
void append_shortest(std::string& to, Real value) {
  char buffer[40];
  to.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// Adds the edits that change the file's numbers to `values`. Normals were normalised when they
/// were read, so that they are compared, and keep their digits, after this.
void replace(std::vector<Edit>& edits, const Numbers& numbers, Encoding encoding,
             const Eigen::Matrix3Xd& values, bool normalised) {
  edits.reserve(edits.size() + static_cast<std::size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    Eigen::Vector3d old = Eigen::Vector3d::Map(&numbers.values[static_cast<std::size_t>(3 * i)]);
    if (normalised) normalise(old);
    if (old == values.col(i)) continue;
    for (Eigen::Index row = 0; row < 3; ++row) {
      const Number& number = numbers.sources[static_cast<std::size_t>(3 * i + row)];
      std::string text;
      append_number(text, values(row, i), number.is_single, encoding);
      edits.push_back({number.bytes, std::move(text)});
    }
  }
}

/// Without its normal, v/vt/vn becomes v/vt, and v//vn becomes v.
void remove_corner_normals(std::vector<Edit>& edits, std::string_view bytes,
                           const std::vector<CornerNormal>& corners) {
  for (const CornerNormal& corner : corners) {
    const std::size_t slashes = bytes[corner.at - 2] == '/' ? 2 : 1;
    edits.push_back({{corner.at - slashes, corner.digits + slashes}, ""});
  }
}

}  // namespace

bool is_allowed(double value, Allowed allowed) {
  return std::isfinite(value) || allowed == Allowed::kAny ||
         (allowed == Allowed::kMissing && std::isnan(value));
}

void normalise(Eigen::Ref<Eigen::Vector3d> normal) {
  if (!normal.allFinite()) normal.setZero();
  normal.stableNormalize();
}

void Location::reject(const std::string& what) const {
  const std::string at_line = line > 0 ? fmt::format(", line {}", line) : "";
  cannot_read(file, fmt::format("{} {} (counted from 0){}: {}", kind, index, at_line, what));
}

void append(Numbers& to, std::span<const Token> words, const Location& where, Allowed allowed,
            bool is_single) {
  for (const Token& word : words) {
    const std::optional<double> value =
        is_single ? std::optional<double>(to_float(word.text)) : to_number(word.text);
    if (!value) where.reject(quoted_ascii(word.text) + " is not a number");
    if (!is_allowed(*value, allowed)) {
      where.reject(quoted_ascii(word.text) + " is not finite" + (is_single ? " as float32" : ""));
    }
    to.values.push_back(*value);
    to.sources.push_back({{word.at, word.text.size()}, is_single});
  }
}

double binary_number(std::string_view bytes, Encoding encoding) {
  return bytes.size() == sizeof(float) ? from_binary<float>(bytes, encoding)
                                       : from_binary<double>(bytes, encoding);
}

void append_column(std::string& to, const Eigen::Matrix3Xd& matrix, Eigen::Index i) {
  for (int row = 0; row < 3; ++row) {
    if (row > 0) to += ' ';
    append_shortest(to, matrix(row, i));
  }
}

void append_number(std::string& to, double value, bool is_single, Encoding encoding) {
  const auto single = static_cast<float>(value);
  if (is_single && !std::isfinite(single)) {
    std::string digits;
    append_shortest(digits, value);
    throw InputError(fmt::format("cannot write {} as float32, which the format asks for", digits));
  }
  if (encoding == Encoding::kText) {
    is_single ? append_shortest(to, single) : append_shortest(to, value);
  } else {
    is_single ? append_binary(to, single, encoding) : append_binary(to, value, encoding);
  }
}

void append_uint32(std::string& to, std::size_t value) {
  append_binary(to, static_cast<std::uint32_t>(value), Encoding::kLittleEndian);
}

std::string substitute(std::string_view bytes, const Layout& layout, const Eigen::Matrix3Xd& V,
                       const Eigen::Matrix3Xd& N, std::vector<Edit> edits) {
  replace(edits, layout.positions, layout.encoding, V, false);
  if (N.cols() > 0 && !layout.normals.values.empty()) {
    replace(edits, layout.normals, layout.encoding, N, true);
  } else {
    for (const ByteRange& range : layout.normal_traces) edits.push_back({range, ""});
    if (layout.shared_normals.values.empty()) remove_corner_normals(edits, bytes, layout.corners);
  }
  const auto place = [](const Edit& edit) { return edit.range.at; };
  if (!std::ranges::is_sorted(edits, {}, place)) std::ranges::stable_sort(edits, {}, place);
  std::string result;
  result.reserve(bytes.size() + bytes.size() / 8);  // numbers of other lengths
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    result.append(bytes.substr(at, edit.range.at - at)).append(edit.text);
    at = edit.range.at + edit.range.size;
  }
  return result.append(bytes.substr(at));
}

}  // namespace deformlab::formats
