#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"
#include "geometry/shape/formats/ply_header.h"

namespace deformlab::formats {
namespace {

std::int64_t binary_integer(std::string_view bytes, PlyType type, Encoding encoding) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.size; ++i) {
    const std::size_t at = encoding == Encoding::kBigEndian ? i : type.size - 1 - i;
    bits = bits << 8 | static_cast<unsigned char>(bytes[at]);
  }
  const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
  const bool negative = type.kind == PlyType::Kind::kSigned && (bits & sign) != 0;
  return static_cast<std::int64_t>(bits) - (negative ? static_cast<std::int64_t>(sign) * 2 : 0);
}

/// How many lines end in a text: with LF, CR LF, or CR alone.
int line_breaks(std::string_view text) {
  int count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    count += text[i] == '\n' || (text[i] == '\r' && !text.substr(i + 1).starts_with('\n'));
  }
  return count;
}

/// A longer face grows as it is read, because the file may announce more corners than it has.
constexpr std::int64_t kUsualCorners = 8;

/// Walks over every number of the body, because only this shows where the next one begins.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), header_(read_ply_header(bytes, name)), at_(header_.end) {
    file_.layout.encoding = header_.encoding;
    if (header_.encoding == Encoding::kText) line_ = 1 + line_breaks(bytes.substr(0, at_));
  }

  ShapeFile run() {
    for (const PlyElement& element : header_.elements) {
      element_ = &element;
      kind_ = element.is_vertex() ? "vertex"
              : element.is_face() ? "face"
                                  : "row of " + quoted_ascii(element.name);
      slots_.assign(element.properties.size(), nullptr);
      if (element.is_vertex()) find_columns(element);
      if (element.properties.empty()) continue;
      for (row_ = 0; row_ < element.rows; ++row_) read_row(element);
    }
    file_.notes = notes_of(header_);
    take_points(file_, name_);
    return std::move(file_);
  }

 private:
  /// Properties that make a vector or a quaternion together.
  struct Columns {
    Numbers* to;
    Allowed allowed;
    std::vector<Number> row;  ///< of the vertex that is being read
    bool is_normal = false;
  };

  Location where() const { return {name_, kind_, row_, line_}; }

  void find_columns(const PlyElement& element) {
    const std::vector<PlyVector> vectors = turning_vectors(element);
    Layout& layout = file_.layout;
    for (const PlyVector& one : vectors) layout.attributes.push_back({one.size(), {}});
    columns_.reserve(vectors.size() + 2);  // slots point into it
    add_columns(element, {"x", "y", "z"}, layout.positions, Allowed::kMissing);
    if (has_all(element, {"nx", "ny", "nz"})) {
      add_columns(element, {"nx", "ny", "nz"}, layout.normals, Allowed::kAny);
      columns_.back().is_normal = true;
    }
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      add_columns(element, vectors[i], layout.attributes[i].numbers, Allowed::kAny);
    }
  }

  void add_columns(const PlyElement& element, const PlyVector& names, Numbers& to,
                   Allowed allowed) {
    columns_.push_back({&to, allowed, std::vector<Number>(names.size())});
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto property = std::ranges::find(element.properties, names[k], &PlyProperty::name);
      slots_[static_cast<std::size_t>(property - element.properties.begin())] =
          &columns_.back().row[k];
      if (names[0] == "nx") file_.layout.normal_traces.push_back(property->line);
    }
  }

  void read_row(const PlyElement& element) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.count_type) {
        read_list(element, property);
        continue;
      }
      const Number number = next(property.type);
      if (slots_[i]) *slots_[i] = number;
    }
    if (element.is_vertex()) add_vertex();
  }

  void add_vertex() {
    for (const Columns& columns : columns_) {
      for (const Number& number : columns.row) {
        add_number(*columns.to, number, columns.allowed);
        if (columns.is_normal) file_.layout.normal_traces.push_back(with_blanks(number.bytes));
      }
    }
  }

  void add_number(Numbers& to, const Number& number, Allowed allowed) const {
    const std::string_view source = text_of(number);
    if (header_.encoding == Encoding::kText) {
      const Token word{number.bytes.at, source};
      return append(to, {&word, 1}, where(), allowed, number.is_single);
    }
    const double value = binary_number(source, header_.encoding);
    if (!is_allowed(value, allowed)) where().reject("a position is infinite");
    to.values.push_back(value);
    to.sources.push_back(number);
  }

  void read_list(const PlyElement& element, const PlyProperty& property) {
    const std::int64_t length = integer(next(*property.count_type), *property.count_type);
    if (length < 0) where().reject("the length of a list is negative");
    if (!element.is_face() || !property.has_corners()) {
      for (std::int64_t i = 0; i < length; ++i) next(property.type);
      return;
    }
    std::vector<int> face;
    face.reserve(static_cast<std::size_t>(std::min<std::int64_t>(length, kUsualCorners)));
    for (std::int64_t i = 0; i < length; ++i) {
      face.push_back(vertex(integer(next(property.type), property.type)));
    }
    file_.shape.faces.push_back(std::move(face));
  }

  /// The next number of the body.
  Number next(PlyType type) {
    const bool is_single = type.kind == PlyType::Kind::kReal && type.size == sizeof(float);
    ByteRange range{at_, type.size};
    if (header_.encoding == Encoding::kText) {
      range.at = find_blank(bytes_, at_, false);
      line_ += line_breaks(bytes_.substr(at_, range.at - at_));
      range.size = find_blank(bytes_, range.at) - range.at;
    }
    if (range.size == 0 || range.size > bytes_.size() - range.at) {
      cannot_read(name_, fmt::format("it announces {} of element {}, but ends in number {}",
                                     element_->rows, quoted_ascii(element_->name), row_));
    }
    at_ = range.at + range.size;
    return {range, is_single};
  }

  std::string_view text_of(const Number& number) const {
    return bytes_.substr(number.bytes.at, number.bytes.size);
  }

  std::int64_t integer(const Number& number, PlyType type) const {
    const std::string_view source = text_of(number);
    if (header_.encoding != Encoding::kText) return binary_integer(source, type, header_.encoding);
    const std::optional<std::int64_t> value = to_integer(source);
    if (!value) where().reject(quoted_ascii(source) + " is not an integer");
    return *value;
  }

  int vertex(std::int64_t index) const {
    constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
    if (index < -kMax || index > kMax) where().reject(fmt::format("there is no vertex {}", index));
    return static_cast<int>(index);
  }

  ByteRange with_blanks(ByteRange range) const {
    if (header_.encoding == Encoding::kText) {
      const std::size_t end = bytes_.find_first_not_of(" \t", range.at + range.size);
      range.size = std::min(end, bytes_.size()) - range.at;
    }
    return range;
  }

  std::string_view bytes_;
  const std::string& name_;
  const PlyHeader header_;
  std::size_t at_;                       ///< where the next number begins
  int line_ = 0;                         ///< of the number that was read last, in a text
  const PlyElement* element_ = nullptr;  ///< the element of the row that is being read
  std::string kind_;                     ///< what messages call this row
  std::uint64_t row_ = 0;                ///< the index of this row
  std::vector<Columns> columns_;         ///< what is read of a vertex
  std::vector<Number*> slots_;           ///< where each property of the element goes, or null
  ShapeFile file_;
};

}  // namespace

ShapeFile read_ply(std::string_view bytes, const std::string& name) {
  return Reader(bytes, name).run();
}

std::string print_ply(const Shape& shape) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      shape.V.cols());
  if (shape.N.cols() > 0) text += "property double nx\nproperty double ny\nproperty double nz\n";
  if (!shape.faces.empty()) {
    text +=
        fmt::format("element face {}\nproperty list uint int vertex_indices\n", shape.faces.size());
  }
  text += "end_header\n";
  const auto append_point = [&](const auto& point) {
    for (const double x : point) append_number(text, x, false, Encoding::kLittleEndian);
  };
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    append_point(shape.V.col(i));
    if (shape.N.cols() > 0) append_point(shape.N.col(i));
  }
  for (const auto& face : shape.faces) {
    append_uint32(text, face.size());
    for (const int v : face) append_uint32(text, static_cast<std::size_t>(v));
  }
  return text;
}

}  // namespace deformlab::formats
