#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "geometry/core/files.h"
#include "geometry/shape/formats/numbers.h"

namespace deformlab::formats {
namespace {

/// The vertices of which a coordinate is NaN.
std::vector<int> without_position(const std::vector<double>& positions) {
  std::vector<int> missing;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    if (!std::isnan(positions[i] + positions[i + 1] + positions[i + 2])) continue;
    missing.push_back(static_cast<int>(i / 3));
  }
  return missing;
}

/// Removes the numbers of missing vertices, each of which has `size`.
void remove(Numbers& numbers, std::size_t size, const std::vector<int>& missing) {
  std::size_t kept = 0, next = 0;
  for (std::size_t i = 0; i < numbers.values.size() / size; ++i) {
    if (next < missing.size() && static_cast<std::size_t>(missing[next]) == i) {
      ++next;
      continue;
    }
    for (std::size_t k = 0; k < size; ++k, ++kept) {
      numbers.values[kept] = numbers.values[size * i + k];
      numbers.sources[kept] = numbers.sources[size * i + k];
    }
  }
  numbers.values.resize(kept);
  numbers.sources.resize(kept);
}

/// The index that each vertex of the file has in the shape, or -1 where it has no position.
std::vector<int> new_indices(std::size_t vertices, const std::vector<int>& missing) {
  std::vector<int> result(vertices, 0);
  for (const int vertex : missing) result[static_cast<std::size_t>(vertex)] = -1;
  int next = 0;
  for (int& index : result) {
    if (index == 0) index = next++;
  }
  return result;
}

void renumber(ShapeFile& file, std::size_t vertices, const std::string& name) {
  const std::vector<int> index = new_indices(vertices, file.missing);
  for (std::size_t f = 0; f < file.shape.faces.size(); ++f) {
    for (int& vertex : file.shape.faces[f]) {
      const bool exists = vertex >= 0 && static_cast<std::size_t>(vertex) < vertices;
      if (!exists || index[static_cast<std::size_t>(vertex)] < 0) {
        cannot_read(
            name, fmt::format("face {} names vertex {} (both counted from 0), which {}", f, vertex,
                              exists ? "has no position: a coordinate is nan" : "does not exist"));
      }
      vertex = index[static_cast<std::size_t>(vertex)];
    }
  }
  for (CornerNormal& corner : file.layout.corners) {
    corner.vertex = index[static_cast<std::size_t>(corner.vertex)];
  }
}

void separate_missing(ShapeFile& file, const std::string& name) {
  Layout& layout = file.layout;
  const std::size_t vertices = layout.positions.values.size() / 3;
  file.missing = without_position(layout.positions.values);
  if (file.missing.empty()) return;
  if (file.missing.size() == vertices) {
    cannot_read(name, fmt::format("none of its {} vertices has a position: all are NaN", vertices));
  }
  renumber(file, vertices, name);
  if (layout.normals.values.size() == layout.positions.values.size()) {
    remove(layout.normals, 3, file.missing);
  }
  remove(layout.positions, 3, file.missing);
  for (Attribute& one : layout.attributes) remove(one.numbers, one.size, file.missing);
  file.notes.push_back(fmt::format(
      "{} of {} vertices have no position (NaN): they stay as they are in the output, and edits "
      "count the others only",
      file.missing.size(), vertices));
}

}  // namespace

void take_points(ShapeFile& file, const std::string& name) {
  separate_missing(file, name);
  const std::vector<double>& positions = file.layout.positions.values;
  const std::vector<double>& normals = file.layout.normals.values;
  file.shape.V = Eigen::Matrix3Xd::Map(positions.data(), 3, std::ssize(positions) / 3);
  if (normals.size() != positions.size()) return;
  file.shape.N = Eigen::Matrix3Xd::Map(normals.data(), 3, std::ssize(normals) / 3);
  std::size_t unusable = 0;
  for (auto normal : file.shape.N.colwise()) {
    if (!normal.allFinite()) ++unusable;
    normalise(normal);
  }
  if (unusable == 0) return;
  file.notes.push_back(fmt::format("{} of {} normals are not finite: they stay as they are",
                                   unusable, file.shape.N.cols()));
}

void note_leftovers(std::vector<std::string>& notes, std::string_view what,
                    const Leftovers& leftovers, std::string_view why) {
  if (leftovers.empty()) return;
  constexpr std::size_t kMost = 12;  // names in one note
  std::vector<std::string> names;
  for (const auto& [name, count] : leftovers) {
    if (names.size() == kMost) {
      names.push_back(fmt::format("and {} more", leftovers.size() - kMost));
      break;
    }
    names.push_back(count == 1 ? quoted_ascii(name)
                               : fmt::format("{} {} times", quoted_ascii(name), count));
  }
  notes.push_back(fmt::format("{} ({}) {}", what, fmt::join(names, ", "), why));
}

}  // namespace deformlab::formats
