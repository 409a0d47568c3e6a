#include <cmath>

#include "geometry/shape/shape_text.h"

namespace deformlab::formats {
namespace {

/// Tells normals from what else stands in columns 4 to 6: colours, intensities.
bool are_normals(const std::vector<Number>& numbers, std::string_view bytes) {
  constexpr double kTolerance = 0.01;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    const double length = std::hypot(value_at(bytes, numbers[i], Encoding::kText),
                                     value_at(bytes, numbers[i + 1], Encoding::kText),
                                     value_at(bytes, numbers[i + 2], Encoding::kText));
    if (!(std::abs(length - 1) <= kTolerance)) return false;
  }
  return !numbers.empty();
}

void read_point(const Lines& lines, std::size_t columns, Scan& scan, const std::string& name) {
  const std::span<const Token> words(lines.tokens());
  const std::string owner = lines.owner("vertex", scan.vertices);
  if (words.size() != columns || columns < 3) {
    reject(name, owner + ": it has " + std::to_string(words.size()) + " numbers; there must be " +
                     (columns < 3 ? "3 or more" : std::to_string(columns) + " as before"));
  }
  append(scan.layout.positions, words.first(3), name, owner);
  for (const Token& word : words.first(3)) scan.plain.append(word.text) += ' ';
  scan.plain.back() = '\n';
  ++scan.vertices;
  if (columns < 6) return;
  for (const Token& word : words.subspan(3, 3)) {
    scan.layout.normals.push_back({word.at, word.text.size()});
  }
  const std::size_t end = columns > 6 ? words[6].at : words[5].at + words[5].text.size();
  scan.layout.normal_traces.push_back({words[3].at, end - words[3].at});
}

}  // namespace

Scan scan_xyz(std::string_view bytes, const std::string& name) {
  Scan scan;
  std::size_t columns = 0, announced = 0;
  for (Lines lines(bytes); lines.next();) {
    const std::vector<Token>& words = lines.tokens();
    // Some files begin with the number of their points.
    if (columns == 0 && announced == 0 && words.size() == 1 && to_integer(words[0].text) > 0) {
      announced = static_cast<std::size_t>(*to_integer(words[0].text));
      continue;
    }
    if (columns == 0) columns = words.size();
    read_point(lines, columns, scan, name);
  }
  if (announced != 0 && announced != scan.vertices) {
    reject(name, "it announces " + std::to_string(announced) + " points, but has " +
                     std::to_string(scan.vertices));
  }
  if (!are_normals(scan.layout.normals, bytes)) {
    scan.layout.normals.clear();
    scan.layout.normal_traces.clear();
  }
  return scan;
}

std::string print_xyz(const Shape& shape) {
  std::string text;
  for (Eigen::Index i = 0; i < shape.V.cols(); ++i) {
    append_column(text, shape.V, i);
    if (shape.N.cols() > 0) append_column(text += ' ', shape.N, i);
    text += '\n';
  }
  return text;
}

}  // namespace deformlab::formats
