#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/shape/shape_ply_header.h"
#include "geometry/shape/shape_text.h"

namespace deformlab::formats {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

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

/// Walks over every number of the body and copies those that CGAL is to read.
class Scanner {
 public:
  Scanner(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), header_(read_ply_header(bytes, name)), at_(header_.end) {
    scan_.layout.encoding = header_.encoding;
  }

  Scan run() {
    std::string plain_header = "ply\nformat " + header_.format + " 1.0\n";
    for (const PlyElement& element : header_.elements) {
      if (element.is_vertex()) plain_header += begin_vertices(element);
      if (element.properties.empty()) continue;
      for (std::uint64_t row = 0; row < element.rows; ++row) {
        owner_ = &element;
        row_ = row;
        read_row(element);
      }
    }
    plain_header += "element face " + std::to_string(scan_.faces) +
                    "\nproperty list int int vertex_indices\nend_header\n";
    scan_.plain = plain_header + vertices_ + faces_;
    return std::move(scan_);
  }

 private:
  std::string where() const {
    const std::string kind = owner_->is_vertex() ? "vertex"
                             : owner_->is_face() ? "face"
                                                 : "row of " + quoted(owner_->name);
    return kind + " " + std::to_string(row_) + " (counted from 0)";
  }

  std::string begin_vertices(const PlyElement& element) {
    std::string text = "element vertex " + std::to_string(element.rows) + "\n";
    for (std::size_t axis = 0; axis < 3; ++axis) {
      position_[axis] = find(element, {"x", "y", "z"}, axis);
      normal_[axis] = find(element, {"nx", "ny", "nz"}, axis);
      text += "property " + position_[axis]->type_name + " " + position_[axis]->name + "\n";
    }
    has_normals_ = std::ranges::all_of(normal_, [](const PlyProperty* p) { return p != nullptr; });
    for (const PlyProperty* property : normal_) {
      if (has_normals_) scan_.layout.normal_traces.push_back(property->line);
    }
    return text;
  }

  static const PlyProperty* find(const PlyElement& element, std::array<const char*, 3> names,
                                 std::size_t axis) {
    for (const PlyProperty& property : element.properties) {
      const bool is_real = property.type.kind == PlyType::Kind::kReal && !property.count_type;
      if (is_real && property.name == names[axis]) return &property;
    }
    return nullptr;
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
    if (element.is_vertex()) add_vertex(position, normal);
  }

  void add_vertex(const std::array<Number, 3>& position, const std::array<Number, 3>& normal) {
    for (const Number& number : position) {
      copy(number, vertices_);
      add_number(scan_.layout.positions, number);
    }
    for (const Number& number : normal) {
      if (!has_normals_) continue;
      add_number(scan_.layout.normals, number);
      scan_.layout.normal_traces.push_back(with_blanks(number));
    }
    ++scan_.vertices;
  }

  void add_number(std::vector<Number>& to, const Number& number) {
    if (header_.encoding == Encoding::kText) {
      const Token word{number.at, bytes_.substr(number.at, number.size)};
      append(to, {&word, 1}, name_, where(), number.is_single);
    } else if (std::isfinite(value_at(bytes_, number, header_.encoding))) {
      to.push_back(number);
    } else {
      reject(name_, where() + ": a position or normal is NaN or infinite");
    }
  }

  void read_list(const PlyElement& element, const PlyProperty& property) {
    const std::int64_t length = integer(next(*property.count_type), *property.count_type);
    if (length < 0) reject(name_, where() + ": the length of a list is negative");
    const bool corners =
        element.is_face() && (property.name == "vertex_indices" || property.name == "vertex_index");
    if (corners) copy_index(length);
    for (std::int64_t i = 0; i < length; ++i) {
      const Number number = next(property.type);
      if (corners) copy_index(integer(number, property.type));
    }
    if (corners) ++scan_.faces;
  }

  Number next(PlyType type) {
    const bool is_single = type.kind == PlyType::Kind::kReal && type.size == sizeof(float);
    Number number{at_, type.size, is_single};
    if (header_.encoding == Encoding::kText) {
      number.at = std::min(bytes_.find_first_not_of(kBlanks, at_), bytes_.size());
      number.size = std::min(bytes_.find_first_of(kBlanks, number.at), bytes_.size()) - number.at;
    }
    if (number.size == 0 || number.size > bytes_.size() - number.at) {
      reject(name_, "it announces " + std::to_string(owner_->rows) + " of element " +
                        quoted(owner_->name) + ", but ends in number " + std::to_string(row_));
    }
    at_ = number.at + number.size;
    return number;
  }

  std::int64_t integer(const Number& number, PlyType type) {
    const std::string_view piece = bytes_.substr(number.at, number.size);
    if (header_.encoding != Encoding::kText) return binary_integer(piece, type, header_.encoding);
    const std::optional<std::int64_t> value = to_integer(piece);
    if (!value) reject(name_, where() + ": " + quoted(piece) + " is not an integer");
    return *value;
  }

  void copy(const Number& number, std::string& to) const {
    to.append(bytes_.substr(number.at, number.size));
    if (header_.encoding == Encoding::kText) to += ' ';
  }

  void copy_index(std::int64_t index) {
    constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
    if (index < -kMax || index > kMax) {
      reject(name_, where() + ": there is no vertex " + std::to_string(index));
    }
    if (header_.encoding == Encoding::kText) {
      faces_ += std::to_string(index) + " ";
    } else {
      for (int i = 0; i < 4; ++i) {
        const int byte = header_.encoding == Encoding::kBigEndian ? 3 - i : i;
        faces_ += static_cast<char>(static_cast<std::uint32_t>(index) >> (8 * byte) & 0xff);
      }
    }
  }

  Span with_blanks(const Number& number) const {
    std::size_t end = number.at + number.size;
    if (header_.encoding == Encoding::kText) {
      end = std::min(bytes_.find_first_not_of(" \t", end), bytes_.size());
    }
    return {number.at, end - number.at};
  }

  std::string_view bytes_;
  const std::string& name_;
  const PlyHeader header_;
  std::size_t at_;
  const PlyElement* owner_ = nullptr;  ///< the row that is being read
  std::uint64_t row_ = 0;
  std::array<const PlyProperty*, 3> position_{}, normal_{};
  bool has_normals_ = false;
  std::string vertices_, faces_;
  Scan scan_;
};

void append_columns(std::string& to, const Eigen::Matrix3Xd& matrix, Eigen::Index i) {
  for (const double value : matrix.col(i)) append_binary(to, value, false, Encoding::kLittleEndian);
}

void append_uint32(std::string& to, std::size_t value) {
  for (int byte = 0; byte < 4; ++byte) to += static_cast<char>(value >> (8 * byte) & 0xff);
}

}  // namespace

Scan scan_ply(std::string_view bytes, const std::string& name) {
  return Scanner(bytes, name).run();
}

std::string print_ply(const Shape& shape) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string(shape.V.cols()) +
                     "\nproperty double x\nproperty double y\nproperty double z\n";
  if (shape.N.cols() > 0) text += "property double nx\nproperty double ny\nproperty double nz\n";
  if (!shape.faces.empty()) {
    text += "element face " + std::to_string(shape.faces.size()) +
            "\nproperty list uint int vertex_indices\n";
  }
  text += "end_header\n";
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    append_columns(text, shape.V, i);
    if (shape.N.cols() > 0) append_columns(text, shape.N, i);
  }
  for (const auto& face : shape.faces) {
    append_uint32(text, face.size());
    for (const int v : face) append_uint32(text, static_cast<std::size_t>(v));
  }
  return text;
}

}  // namespace deformlab::formats
