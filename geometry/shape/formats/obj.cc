#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"

namespace deformlab::formats {
namespace {

/// What OBJ has besides vertices, normals and faces. It is kept as it is.
constexpr std::array<std::string_view, 36> kKept = {
    "vt",        "vp",     "l",      "p",        "g",        "o",     "s",    "mg",   "usemtl",
    "mtllib",    "usemap", "maplib", "cstype",   "deg",      "bmat",  "step", "curv", "curv2",
    "surf",      "parm",   "trim",   "hole",     "scrv",     "sp",    "end",  "con",  "shadow_obj",
    "trace_obj", "ctech",  "stech",  "c_interp", "d_interp", "bevel", "lod",  "call", "csh"};

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
    while (lines_.next()) read_line();
    if (!one_index_ || count(layout_.normals) != count(layout_.positions)) share_normals();
    note_leftovers(file_.notes, "lines of unknown kinds", unknown_, "are kept as they are");
    if (small_faces_ > 0) {
      file_.notes.push_back(
          fmt::format("faces of one or two corners ({}) are kept as they are, but are no surface",
                      small_faces_));
    }
    check_vertices();
    take_points(file_, name_);
    return std::move(file_);
  }

 private:
  static std::size_t count(const Numbers& numbers) { return numbers.values.size() / 3; }

  void read_line() {
    const std::string_view keyword = lines_.tokens()[0].text;
    if (keyword == "v") return vertex();
    if (keyword == "vn") return normal();
    if (keyword == "f" || keyword == "fo") return face();
    if (std::ranges::find(kKept, keyword) != kKept.end()) return;
    ++unknown_[std::string(keyword)];
  }

  void append_three(Numbers& to, const Location& where, Allowed allowed) const {
    const std::span<const Token> words(lines_.tokens());
    if (words.size() < 4) where.reject("it has fewer than 3 numbers");
    append(to, words.subspan(1, 3), where, allowed);
  }

  void vertex() {
    append_three(layout_.positions, {name_, "vertex", count(layout_.positions), lines_.number()},
                 Allowed::kMissing);
  }

  void normal() {
    append_three(layout_.normals, {name_, "normal", count(layout_.normals), lines_.number()},
                 Allowed::kAny);
    layout_.normal_traces.push_back(lines_.range());
  }

  void face() {
    const std::vector<Token>& words = lines_.tokens();
    const Location where{name_, "face", file_.shape.faces.size(), lines_.number()};
    std::vector<int>& face = file_.shape.faces.emplace_back();
    face.reserve(words.size() - 1);
    for (std::size_t c = 1; c < words.size(); ++c) face.push_back(read_corner(words[c], where));
    if (face.size() >= 3) return;
    ++small_faces_;
    file_.shape.faces.pop_back();
  }

  /// Reads v, v/vt, v//vn or v/vt/vn. Some programs write slashes with nothing behind them.
  int read_corner(const Token& word, const Location& where) {
    const std::size_t first = word.text.find('/');
    const std::int64_t v = absolute(word.text.substr(0, first), count(layout_.positions), where);
    if (v < 0) where.reject("there is no vertex " + quoted_ascii(word.text));
    if (v > greatest_.vertex) greatest_ = {v, where.index, where.line};
    const std::size_t second = first == word.text.npos ? first : word.text.find('/', first + 1);
    const std::string_view index = second == word.text.npos ? "" : word.text.substr(second + 1);
    if (index.empty()) {
      one_index_ = one_index_ && layout_.normals.values.empty();
      return static_cast<int>(v);
    }
    const std::int64_t vn = absolute(index, count(layout_.normals), where);
    one_index_ = one_index_ && v == vn;
    layout_.corners.push_back({word.at + second + 1, static_cast<int>(v), static_cast<int>(vn),
                               static_cast<std::uint8_t>(index.size()), index[0] == '-'});
    return static_cast<int>(v);
  }

  /// A face may name vertices that stand behind it, so that this is known at the end only.
  void check_vertices() const {
    const std::size_t vertices = count(layout_.positions);
    if (vertices == 0) cannot_read(name_, "it has no vertices, which are lines 'v x y z' in OBJ");
    const auto [vertex, face, line] = greatest_;
    if (vertex < static_cast<std::int64_t>(vertices)) return;
    Location{name_, "face", face, line}.reject(fmt::format(
        "there is no vertex {}; the file has {}, counted from 1", vertex + 1, vertices));
  }

  /// The normals belong to corners, not to vertices.
  void share_normals() {
    std::swap(layout_.shared_normals, layout_.normals);
    if (!layout_.normal_traces.empty()) {
      const ByteRange last = layout_.normal_traces.back();
      layout_.normals_end = last.at + last.size;
    }
    layout_.normal_traces.clear();
    const auto normals = static_cast<int>(count(layout_.shared_normals));
    const auto strays = std::erase_if(layout_.corners, [&](const CornerNormal& corner) {
      return corner.normal < 0 || corner.normal >= normals;
    });
    if (strays == 0) return;
    file_.notes.push_back(fmt::format(
        "{} corners of faces name a normal that does not exist: they stay as they are", strays));
  }

  Lines lines_;
  const std::string& name_;
  ShapeFile file_;
  Layout& layout_ = file_.layout;
  bool one_index_ = true;  ///< each corner so far has the same index for its vertex and its normal
  std::size_t small_faces_ = 0;
  /// The greatest vertex that a face names, counted from 0, and where it does so first.
  struct {
    std::int64_t vertex = -1;
    std::size_t face = 0;
    int line = 0;
  } greatest_;
  Leftovers unknown_;  ///< the first words of lines that OBJ does not have
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
