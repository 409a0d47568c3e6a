#include "experiments/subjects/particles/particle_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "experiments/config/csv.h"
#include "experiments/config/suggest.h"
#include "geometry/core/error.h"
#include "geometry/core/files.h"
#include "geometry/core/text.h"
#include "geometry/shape/shape.h"

namespace deformlab {
namespace {

constexpr const char* kColumns[] = {"frame", "id", "x", "y", "z"};

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

ParticleReader::ParticleReader(const std::filesystem::path& path) : name_(path.string()) {
  check_readable(path);
  file_.open(path, std::ios::binary);
  if (!file_) cannot_read(path, "it cannot be opened");
  read_header();
}

void ParticleReader::reject(const std::string& why) const {
  throw InputError(fmt::format("line {} of '{}': {}", line_number_, name_, why));
}

bool ParticleReader::read_line() {
  std::streambuf& text = *file_.rdbuf();
  line_.clear();
  ending_.clear();
  constexpr int kEnd = std::char_traits<char>::eof();
  int c = text.sbumpc();
  for (; c != kEnd && c != '\n' && c != '\r'; c = text.sbumpc()) line_ += static_cast<char>(c);
  if (c == kEnd && line_.empty()) return false;
  ++line_number_;
  if (c != kEnd) ending_ = static_cast<char>(c);
  if (c == '\r' && text.sgetc() == '\n') ending_ += static_cast<char>(text.sbumpc());
  return true;
}

void ParticleReader::read_header() {
  while (read_line()) {
    between_ += line_ + ending_;
    if (line_.starts_with(kByteOrderMark)) line_.erase(0, 3);
    if (!trimmed(line_).empty()) break;
  }
  split_csv(line_, fields_);
  header_size_ = fields_.size();
  for (int c = 0; c < 5; ++c) {
    const auto found = std::ranges::find(fields_, kColumns[c], lower_case);
    if (found == fields_.end()) {
      line_number_ = std::max<std::int64_t>(line_number_, 1);
      reject(fmt::format("the column '{}' is missing; the header is: frame,id,x,y,z", kColumns[c]));
    }
    columns_[c] = static_cast<std::size_t>(found - fields_.begin());
  }
}

double ParticleReader::coordinate(int column) const {
  const std::string_view text = field(column);
  const std::optional<double> value = to_number(text);
  if (!value || std::abs(*value) > kMostLength) {
    reject(
        fmt::format("{} is {}; it has to be a number of at most {:g}, or nan where the particle "
                    "has no position",
                    kColumns[column], quote(std::string(text)), kMostLength));
  }
  return *value;
}

std::int64_t ParticleReader::integer(int column) const {
  const std::string_view text = field(column);
  const std::optional<std::int64_t> value = to_integer(text);
  if (value) return *value;
  reject(fmt::format("{} is {}; it has to be a whole number of at most 64 bits", kColumns[column],
                     quote(std::string(text))));
}

std::optional<ParticleRow> ParticleReader::next() {
  if (number_ > 0) between_.clear();
  while (read_line()) {
    if (trimmed(line_).empty()) {
      between_ += line_ + ending_;
      continue;
    }
    split_csv(line_, fields_);
    if (fields_.size() != header_size_) {
      reject(fmt::format("it has {} fields, but the header has {}", fields_.size(), header_size_));
    }
    ParticleRow row{integer(0), integer(1), {}, number_, line_number_};
    for (int c = 0; c < 3; ++c) row.position[c] = coordinate(2 + c);
    if (row.position.hasNaN()) {
      between_ += line_ + ending_;
      ++missing_;
      continue;
    }
    ++number_;
    return row;
  }
  return {};
}

std::string ParticleReader::moved(const Eigen::Vector3d& position) const {
  std::string text;
  const char* copied = line_.data();
  std::vector<std::size_t> order{columns_[2], columns_[3], columns_[4]};
  std::ranges::sort(order);
  for (const std::size_t column : order) {
    const std::string_view old = fields_[column];
    text.append(copied, old.data());
    text +=
        shortest(position[std::ranges::find(columns_ + 2, columns_ + 5, column) - columns_ - 2]);
    copied = old.data() + old.size();
  }
  text.append(copied, line_.data() + line_.size());
  return text + ending_;
}

}  // namespace deformlab
