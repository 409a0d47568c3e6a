#include <fmt/format.h>

#include <iterator>
#include <limits>

#include "geometry/shape/formats/numbers.h"

namespace deformlab::formats {
namespace {

/// A corner of a face, v/vt/vn.
struct Corner {
  std::int64_t v = 0, vn = -1;  ///< counted from 0; vn is -1 where the corner has no normal
};

/// An index as a number that counts from 0. The file counts from 1, or from −1 backwards from the
/// newest of the `count` vertices or normals that stand before it.
std::int64_t absolute(std::string_view word, std::size_t count, const Location& where) {
  const std::optional<std::int64_t> value = to_integer(word);
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  if (!value || *value == 0 || *value > kMax || *value < -kMax) {
    where.reject(quoted_ascii(word) + " is not an index; they count from 1, or from -1 backwards");
  }
  return *value > 0 ? *value - 1 : static_cast<std::int64_t>(count) + *value;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : lines_(bytes, true), name_(name) {}

  ShapeFile run() {
    while (lines_.next()) {
      const std::string_view keyword = lines_.tokens()[0].text;
      if (keyword == "v") vertex();
      if (keyword == "vn") normal();
      if (keyword == "f") face();
    }
    if (!one_index_ || count(layout_.normals) != count(layout_.positions)) layout_.normals = {};
    take_points(file_);
    return std::move(file_);
  }

 private:
  static std::size_t count(const Numbers& numbers) { return numbers.values.size() / 3; }

  void append_three(Numbers& to, const Location& where) const {
    const std::span<const Token> words(lines_.tokens());
    if (words.size() < 4) where.reject("it has fewer than 3 numbers");
    append(to, words.subspan(1, 3), where);
  }

  void vertex() {
    append_three(layout_.positions, {name_, "vertex", count(layout_.positions), lines_.number()});
  }

  void normal() {
    append_three(layout_.normals, {name_, "normal", count(layout_.normals), lines_.number()});
    layout_.normal_traces.push_back(lines_.range());
  }

  void face() {
    const std::vector<Token>& words = lines_.tokens();
    const Location where{name_, "face", file_.shape.faces.size(), lines_.number()};
    if (words.size() < 4) where.reject("it has fewer than 3 corners");
    std::vector<int>& face = file_.shape.faces.emplace_back();
    face.reserve(words.size() - 1);
    for (std::size_t c = 1; c < words.size(); ++c) {
      const Corner corner = read_corner(words[c], where);
      one_index_ = one_index_ && corner.v == corner.vn;
      face.push_back(static_cast<int>(corner.v));
    }
  }

  Corner read_corner(const Token& word, const Location& where) {
    Corner corner;
    const std::size_t first = word.text.find('/');
    corner.v = absolute(word.text.substr(0, first), count(layout_.positions), where);
    if (corner.v < 0) where.reject("there is no vertex " + quoted_ascii(word.text));
    if (first == std::string_view::npos) return corner;
    const std::size_t second = word.text.find('/', first + 1);
    if (second == std::string_view::npos) return corner;
    corner.vn = absolute(word.text.substr(second + 1), count(layout_.normals), where);
    // Without its normal, v/vt/vn becomes v/vt, and v//vn becomes v.
    const std::size_t cut = second == first + 1 ? first : second;
    layout_.normal_traces.push_back({word.at + cut, word.text.size() - cut});
    return corner;
  }

  Lines lines_;
  const std::string& name_;
  ShapeFile file_;
  Layout& layout_ = file_.layout;
  bool one_index_ = true;  ///< each corner so far has the same index for its vertex and its normal
};

}  // namespace

ShapeFile read_obj(std::string_view bytes, const std::string& name) {
  return Reader(bytes, name).run();
}

std::string print_obj(const Shape& shape) {
  const bool has_normals = shape.N.cols() > 0;
  std::string text;
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    append_column(text += "v ", shape.V, i);
    text += '\n';
  }
  for (Eigen::Index i = 0; i < shape.N.cols(); ++i) {
    append_column(text += "vn ", shape.N, i);
    text += '\n';
  }
  for (const auto& face : shape.faces) {
    if (face.empty()) continue;
    // A face has three corners or more in OBJ; smaller ones are points and lines.
    text += face.size() >= 3 ? 'f' : face.size() == 2 ? 'l' : 'p';
    for (const int v : face) {
      fmt::format_to(std::back_inserter(text), " {}", v + 1);
      if (has_normals && face.size() >= 3) {
        fmt::format_to(std::back_inserter(text), "//{}", v + 1);
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace deformlab::formats
