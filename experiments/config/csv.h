#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// Splits a line of a CSV file into fields, which are views of the line without the blanks and
/// quotes around them.
void split_csv(std::string_view line, std::vector<std::string_view>& fields);

/// A small CSV file. Its header names the columns in any order, in small or capital letters, and
/// may name others. Lines end with LF, CR LF or CR, and blank lines are skipped.
class CsvTable {
 public:
  /// Throws InputError (naming the line) if the file cannot be read, lacks one of these columns, or
  /// has a row with another number of fields than its header.
  CsvTable(const std::filesystem::path& path, const std::vector<std::string>& columns);

  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string& column) const;
  /// "line 7 of moves.csv"
  std::string where(std::size_t row) const;
  const std::string& text(std::size_t row, const std::string& column) const;
  /// Throws InputError (naming the line) if the field is not a finite number, or beyond
  /// kMostLength.
  double number(std::size_t row, const std::string& column) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> fields;
  };
  void check_header(int line, const std::vector<std::string>& columns) const;
  std::size_t index_of(const std::string& column) const;
  std::string line_name(int line) const;

  std::string name_;
  std::vector<std::string> header_;  // in small letters
  std::vector<Row> rows_;
};

}  // namespace deformlab
