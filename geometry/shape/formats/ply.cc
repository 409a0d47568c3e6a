#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// Walks over every number of the body, because only this shows where the next one begins.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), header_(read_ply_header(bytes, name)), at_(header_.end) {
    file_.layout.encoding = header_.encoding;
  }

  ShapeFile run() {
    for (const PlyElement& element : header_.elements) {
      element_ = &element;
      kind_ = element.is_vertex() ? "vertex"
              : element.is_face() ? "face"
                                  : "row of " + quoted_ascii(element.name);
      if (element.is_vertex()) find_columns(element);
      if (element.properties.empty()) continue;
      for (row_ = 0; row_ < element.rows; ++row_) read_row(element);
    }
    take_points(file_);
    return std::move(file_);
  }

 private:
  using Properties = std::array<const PlyProperty*, 3>;

  Location where() const { return {name_, kind_, row_}; }

  void find_columns(const PlyElement& element) {
    position_ = find(element, {"x", "y", "z"});
    normal_ = find(element, {"nx", "ny", "nz"});
    has_normals_ = std::ranges::all_of(normal_, [](const PlyProperty* p) { return p != nullptr; });
    if (!has_normals_) return;
    for (const PlyProperty* property : normal_) {
      file_.layout.normal_traces.push_back(property->line);
    }
  }

  static Properties find(const PlyElement& element, const std::array<const char*, 3>& names) {
    Properties found{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto property = std::ranges::find_if(element.properties, [&](const PlyProperty& p) {
        return p.type.kind == PlyType::Kind::kReal && !p.count_type && p.name == names[axis];
      });
      if (property != element.properties.end()) found[axis] = &*property;
    }
    return found;
  }

  void read_row(const PlyElement& element) {
    std::array<Number, 3> position, normal;
    for (const PlyProperty& property : element.properties) {
      if (property.count_type) {
        read_list(element, property);
        continue;
      }
      const Number number = next(property.type);
      if (!element.is_vertex()) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (position_[axis] == &property) position[axis] = number;
        if (normal_[axis] == &property) normal[axis] = number;
      }
    }
    if (!element.is_vertex()) return;
    for (const Number& number : position) add_number(file_.layout.positions, number);
    if (has_normals_) add_normal(normal);
  }

  void add_normal(const std::array<Number, 3>& normal) {
    for (const Number& number : normal) {
      add_number(file_.layout.normals, number);
      file_.layout.normal_traces.push_back(with_blanks(number.bytes));
    }
  }

  void add_number(Numbers& to, const Number& number) const {
    const std::string_view source = text_of(number);
    if (header_.encoding == Encoding::kText) {
      const Token word{number.bytes.at, source};
      return append(to, {&word, 1}, where(), number.is_single);
    }
    const double value = binary_number(source, header_.encoding);
    if (!std::isfinite(value)) where().reject("a position or normal is NaN or infinite");
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
  const PlyElement* element_ = nullptr;  ///< the element of the row that is being read
  std::string kind_;                     ///< what messages call this row
  std::uint64_t row_ = 0;                ///< the index of this row
  Properties position_{}, normal_{};     ///< the properties of vertices for x, y, z
  bool has_normals_ = false;
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
