#include "experiments/subjects/shape/edit_files.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"

namespace deformlab {
namespace {

constexpr const char* kBetween = " \t\r,;";

std::string text_in(const std::filesystem::path& path, const std::string& where) {
  try {
    return read_file(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", where, error.what()));
  }
}

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || last != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> words(std::string_view line, const char* between) {
  std::vector<std::string_view> result;
  std::size_t begin = 0;
  while ((begin = line.find_first_not_of(between, begin)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(between, begin), line.size());
    result.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return result;
}

// The numbers of a line, or nothing if one of its words is none.
std::optional<std::vector<double>> numbers(const std::vector<std::string_view>& line) {
  std::vector<double> result;
  for (const std::string_view word : line) {
    const std::optional<double> value = number<double>(word);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

Eigen::Vector3d place(const double* numbers, int dimension) {
  return {numbers[0], numbers[1], dimension == 3 ? numbers[2] : 0};
}

// A target of a line's numbers, or nothing if they are too few, too many or no index.
std::optional<ListedTarget> listed_target(const std::vector<double>& row, int dimension) {
  const auto count = std::ssize(row);
  if (count == 2 * dimension) {
    return ListedTarget{-1, place(row.data(), dimension), place(row.data() + dimension, dimension)};
  }
  if (count != 1 + dimension) return std::nullopt;
  const bool is_index =
      row[0] >= 0 && row[0] <= std::numeric_limits<int>::max() && row[0] == std::floor(row[0]);
  if (!is_index) return std::nullopt;
  return ListedTarget{static_cast<int>(row[0]), {0, 0, 0}, place(row.data() + 1, dimension)};
}

std::string expected_target(int dimension) {
  const char* axes = dimension == 3 ? "x,y,z" : "x,y";
  return fmt::format(
      "expected {} numbers, the index of a vertex and its target {}, or {}, a place {} and its "
      "target",
      1 + dimension, axes, 2 * dimension, axes);
}

}  // namespace

std::vector<int> read_indices(const std::filesystem::path& path, const std::string& where) {
  std::istringstream file(text_in(path, where));
  std::vector<int> indices;
  std::string line;
  for (int n = 1; std::getline(file, line); ++n) {
    const std::vector<std::string_view> found = words(line, " \t\r");
    if (found.empty()) continue;
    const std::optional<int> index = found.size() == 1 ? number<int>(found[0]) : std::nullopt;
    if (!index) {
      throw InputError(fmt::format("{}: expected a vertex index (line {} of {}), found {}", where,
                                   n, path.string(), quote(line)));
    }
    indices.push_back(*index);
  }
  return indices;
}

std::vector<ListedTarget> read_targets(const std::filesystem::path& path, int dimension,
                                       const std::string& where) {
  std::istringstream file(text_in(path, where));
  std::vector<ListedTarget> targets;
  std::string line;
  bool may_be_names = true;
  for (int n = 1; std::getline(file, line); ++n) {
    const std::vector<std::string_view> found = words(line, kBetween);
    if (found.empty() || found[0].starts_with('#')) continue;
    const std::optional<std::vector<double>> row = numbers(found);
    const bool is_names = may_be_names && !number<double>(found[0]);
    may_be_names = false;
    if (is_names) continue;
    const std::optional<ListedTarget> target = row ? listed_target(*row, dimension) : std::nullopt;
    if (!target) {
      throw InputError(fmt::format("{}: {} (line {} of {}); found {}", where,
                                   expected_target(dimension), n, path.string(), quote(line)));
    }
    targets.push_back(*target);
    targets.back().line = n;
  }
  if (!targets.empty()) return targets;
  throw InputError(fmt::format("{}: the file {} has no targets; {} in each line", where,
                               path.string(), expected_target(dimension)));
}

}  // namespace deformlab
