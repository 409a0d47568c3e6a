#include "experiments/config/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/text.h"
#include "geometry/shape/shape.h"

namespace deformlab {
namespace {

// The comma that ends the field at `begin`. A field in quotes may contain commas; two quotes in it
// stand for one, which changes nothing here.
std::size_t find_comma(std::string_view line, std::size_t begin) {
  const std::size_t text = line.find_first_not_of(" \t", begin);
  if (text == std::string_view::npos || line[text] != '"') return line.find(',', begin);
  bool is_quoted = false;
  for (std::size_t at = text; at < line.size(); ++at) {
    if (line[at] == '"') is_quoted = !is_quoted;
    if (line[at] == ',' && !is_quoted) return at;
  }
  return std::string_view::npos;
}

std::string_view unquoted(std::string_view field) {
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

// The next line without its end, which is taken from the text.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  const bool two = text.substr(end).starts_with("\r\n");
  text.remove_prefix(std::min(text.size(), end + (two ? 2 : 1)));
  return line;
}

}  // namespace

void split_csv(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0;;) {
    const std::size_t comma = find_comma(line, begin);
    fields.push_back(unquoted(trimmed(line.substr(begin, comma - begin))));
    if (comma == std::string_view::npos) return;
    begin = comma + 1;
  }
}

CsvTable::CsvTable(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : name_(path.string()) {
  const std::string bytes = read_file(path);
  std::string_view text = bytes;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(3);
  std::vector<std::string_view> fields;
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view content = trimmed(next_line(text));
    if (content.empty()) continue;
    split_csv(content, fields);
    if (header_.empty()) {
      for (const std::string_view field : fields) header_.push_back(lower_case(field));
      check_header(line, columns);
    } else if (fields.size() != header_.size()) {
      throw InputError(fmt::format("{}: it has {} fields, but the header has {}", line_name(line),
                                   fields.size(), header_.size()));
    } else {
      rows_.push_back({line, {fields.begin(), fields.end()}});
    }
  }
  if (header_.empty()) check_header(1, columns);
}

void CsvTable::check_header(int line, const std::vector<std::string>& columns) const {
  for (const std::string& column : columns) {
    if (has(column)) continue;
    throw InputError(fmt::format("{}: the column '{}' is missing; the header is: {}",
                                 line_name(line), column, fmt::join(columns, ",")));
  }
}

std::string CsvTable::line_name(int line) const {
  return fmt::format("line {} of '{}'", line, name_);
}

std::string CsvTable::where(std::size_t row) const { return line_name(rows_[row].line); }

std::size_t CsvTable::index_of(const std::string& column) const {
  return static_cast<std::size_t>(std::ranges::find(header_, column) - header_.begin());
}

bool CsvTable::has(const std::string& column) const { return index_of(column) < header_.size(); }

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  return rows_[row].fields[index_of(column)];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::string& field = text(row, column);
  const std::optional<double> value = to_number(field);
  if (value && std::abs(*value) <= kMostLength) return *value;
  throw InputError(fmt::format("{}: {} is {}; it has to be a finite number of at most {:g}",
                               where(row), column, quote(field), kMostLength));
}

}  // namespace deformlab
