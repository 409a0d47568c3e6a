#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"

namespace deformlab::formats {
namespace {

/// Distinguishes normals from what else columns 4 to 6 may contain: colours, intensities. Points
/// without a position, and others as well, may have the normal NaN.
bool are_normals(const std::vector<double>& values) {
  constexpr double kTolerance = 0.01;
  bool found = false;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    const double length = std::hypot(values[i], values[i + 1], values[i + 2]);
    if (std::isnan(length)) continue;
    if (!(std::abs(length - 1) <= kTolerance)) return false;
    found = true;
  }
  return found;
}

void read_point(const std::vector<Token>& tokens, std::size_t columns, Layout& layout,
                const Location& where) {
  const std::span<const Token> words(tokens);
  if (words.size() != columns || columns < 3) {
    where.reject(fmt::format("it has {} numbers; there must be {}", words.size(),
                             columns < 3 ? "3 or more" : fmt::format("{} as before", columns)));
  }
  append(layout.positions, words.first(3), where, Allowed::kMissing);
  if (columns < 6) return;
  for (const Token& word : words.subspan(3, 3)) {
    constexpr double kNoNormal = std::numeric_limits<double>::infinity();
    layout.normals.values.push_back(to_number(word.text).value_or(kNoNormal));
    layout.normals.sources.push_back({{word.at, word.text.size()}});
  }
  const std::size_t end = columns > 6 ? words[6].at : words[5].at + words[5].text.size();
  layout.normal_traces.push_back({words[3].at, end - words[3].at});
}

}  // namespace

ShapeFile read_xyz(std::string_view bytes, const std::string& name) {
  ShapeFile file;
  std::size_t columns = 0, announced = 0, vertices = 0;
  for (Lines lines(bytes); lines.next();) {
    const std::vector<Token>& words = lines.tokens();
    // Some files begin with the number of their points.
    if (columns == 0 && announced == 0 && words.size() == 1 && to_integer(words[0].text) > 0) {
      announced = static_cast<std::size_t>(*to_integer(words[0].text));
      continue;
    }
    if (columns == 0) columns = words.size();
    read_point(words, columns, file.layout, {name, "vertex", vertices, lines.number()});
    ++vertices;
  }
  if (announced != 0 && announced != vertices) {
    cannot_read(name, fmt::format("it announces {} points, but has {}", announced, vertices));
  }
  if (!are_normals(file.layout.normals.values)) {
    file.layout.normals = {};
    file.layout.normal_traces.clear();
  }
  take_points(file, name);
  return file;
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
