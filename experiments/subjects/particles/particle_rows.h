#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace deformlab {

/// A row of a particle cache: the position of one particle in one frame.
struct ParticleRow {
  std::int64_t frame = 0;
  std::int64_t id = 0;
  Eigen::Vector3d position{0, 0, 0};  ///< [length]
  std::int64_t number = 0;            ///< of the row, from 0
  std::int64_t line = 0;              ///< of the file, from 1
};

/// Reads a particle cache row by row. It is a text whose header names the columns frame, id, x, y
/// and z in any order and in small or capital letters, and may name others. Fields may be in
/// quotes, and numbers may begin with a plus. Lines end with LF, CR LF or CR, and blank lines are
/// skipped.
class ParticleReader {
 public:
  /// Throws InputError if the file cannot be read or its header lacks a column.
  explicit ParticleReader(const std::filesystem::path& path);

  /// The next row that has a position, or nothing at the end. A row of which a coordinate is NaN
  /// has none and is skipped. Throws InputError (naming the line) if a row does not have as many
  /// fields as the header, or if one of the five is not a number that is allowed.
  std::optional<ParticleRow> next();

  /// How many rows without a position were skipped so far.
  std::int64_t missing() const { return missing_; }
  /// The text that `next` skipped before its last row, or before the end of the file.
  const std::string& between() const { return between_; }
  /// The text of the last row, in which only the coordinates are replaced.
  std::string moved(const Eigen::Vector3d& position) const;

 private:
  bool read_line();
  void read_header();
  [[noreturn]] void reject(const std::string& why) const;
  std::string_view field(int column) const { return fields_[columns_[column]]; }
  double coordinate(int column) const;
  std::int64_t integer(int column) const;

  std::string name_;
  std::ifstream file_;
  std::string line_, ending_, between_;
  std::vector<std::string_view> fields_;  // of line_
  std::size_t header_size_ = 0;
  std::size_t columns_[5] = {};  // where frame, id, x, y, z are
  std::int64_t number_ = 0, line_number_ = 0, missing_ = 0;
};

}  // namespace deformlab
