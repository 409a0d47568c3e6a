#include <limits>

#include "geometry/shape/shape_text.h"

namespace deformlab::formats {
namespace {

/// A corner of a face, v/vt/vn: indices from 0, and where the file names the normal.
struct Corner {
  std::int64_t v = 0, vn = -1;
  Span normal_trace;  ///< "/vn", or "//vn" where there is no texture coordinate
};

/// From 1, or from −1 backwards from the newest one.
std::int64_t absolute(std::string_view word, std::size_t count, const std::string& name,
                      const std::string& owner) {
  const std::optional<std::int64_t> value = to_integer(word);
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  if (!value || *value == 0 || *value > kMax || *value < -kMax) {
    reject(name, owner + ": " + quoted(word) + " is not an index; they count from 1, or " +
                     "from -1 backwards");
  }
  return *value > 0 ? *value - 1 : static_cast<std::int64_t>(count) + *value;
}

class Scanner {
 public:
  Scanner(std::string_view bytes, const std::string& name) : lines_(bytes, true), name_(name) {}

  Scan run() {
    while (lines_.next()) {
      const std::string_view keyword = lines_.tokens()[0].text;
      if (keyword == "v") vertex();
      if (keyword == "vn") normal();
      if (keyword == "f") face();
    }
    Layout& layout = scan_.layout;
    if (!one_index_ || layout.normals.size() != layout.positions.size()) layout.normals.clear();
    return std::move(scan_);
  }

 private:
  std::span<const Token> three_words(const std::string& owner) {
    const std::span<const Token> words(lines_.tokens());
    if (words.size() < 4) reject(name_, owner + ": it has fewer than 3 numbers");
    return words.subspan(1, 3);
  }

  void vertex() {
    const std::string owner = lines_.owner("vertex", scan_.vertices);
    const std::span<const Token> words = three_words(owner);
    append(scan_.layout.positions, words, name_, owner);
    scan_.plain += 'v';
    for (const Token& word : words) scan_.plain.append(" ").append(word.text);
    scan_.plain += '\n';
    ++scan_.vertices;
  }

  void normal() {
    const std::string owner = "normal, " + lines_.number();
    append(scan_.layout.normals, three_words(owner), name_, owner);
    scan_.layout.normal_traces.push_back(lines_.span());
  }

  void face() {
    const std::span<const Token> words(lines_.tokens());
    const std::string owner = lines_.owner("face", scan_.faces);
    if (words.size() < 4) reject(name_, owner + ": it has fewer than 3 corners");
    scan_.plain += 'f';
    for (const Token& word : words.subspan(1)) {
      const Corner corner = read_corner(word, owner);
      one_index_ = one_index_ && corner.v == corner.vn;
      scan_.plain.append(" ").append(std::to_string(corner.v + 1));
    }
    scan_.plain += '\n';
    ++scan_.faces;
  }

  Corner read_corner(const Token& word, const std::string& owner) {
    Corner corner;
    const std::size_t first = word.text.find('/');
    corner.v = absolute(word.text.substr(0, first), scan_.vertices, name_, owner);
    if (corner.v < 0) reject(name_, owner + ": there is no vertex " + quoted(word.text));
    if (first == std::string_view::npos) return corner;
    const std::size_t second = word.text.find('/', first + 1);
    if (second == std::string_view::npos) return corner;
    corner.vn =
        absolute(word.text.substr(second + 1), scan_.layout.normals.size() / 3, name_, owner);
    const std::size_t cut = second == first + 1 ? first : second;
    scan_.layout.normal_traces.push_back({word.at + cut, word.text.size() - cut});
    return corner;
  }

  Lines lines_;
  const std::string& name_;
  Scan scan_;
  bool one_index_ = true;
};

}  // namespace

Scan scan_obj(std::string_view bytes, const std::string& name) {
  return Scanner(bytes, name).run();
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
    // A face has three corners or more here; smaller ones are points and lines.
    text += face.size() >= 3 ? 'f' : face.size() == 2 ? 'l' : 'p';
    for (const int v : face) {
      const std::string index = std::to_string(v + 1);
      text.append(" ").append(index);
      if (has_normals && face.size() >= 3) text.append("//").append(index);
    }
    text += '\n';
  }
  return text;
}

}  // namespace deformlab::formats
