#include "geometry/core/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <type_traits>

namespace deformlab {
namespace {

std::string_view without_plus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return has_plus ? word.substr(1) : word;
}

template <class Real>
std::optional<Real> to_real(std::string_view word) {
  word = without_plus(word);
  const char* end = word.data() + word.size();
  Real value = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) return {};
  if (error != std::errc::result_out_of_range) return value;
  // from_chars gives no value here; strtod and strtof give 0, a subnormal number or infinity.
  const std::string copy(word);
  if constexpr (std::is_same_v<Real, float>) return std::strtof(copy.c_str(), nullptr);
  return static_cast<Real>(std::strtod(copy.c_str(), nullptr));
}

}  // namespace

// Hardly any file joins lines, and one look at it saves a look at each of them.
Lines::Lines(std::string_view bytes, bool continued)
    : bytes_(bytes), continued_(continued && bytes.find('\\') != std::string_view::npos) {
  if (bytes.starts_with(kByteOrderMark)) end_ = kByteOrderMark.size();
  line_feed_ = std::min(bytes.find('\n'), bytes.size());
  return_ = std::min(bytes.find('\r'), bytes.size());
}

bool Lines::next() {
  do {
    if (end_ >= bytes_.size()) return false;
    begin_ = end_;
    number_ = next_number_;
    find_end();
    split();
  } while (tokens_.empty());
  return true;
}

void Lines::find_end() {
  end_ = begin_;
  bool joined = continued_;
  do {
    const std::size_t begin = end_;
    end_ = find_break(begin);
    ++next_number_;
    joined = continued_ && is_joined(bytes_.substr(begin, end_ - begin));
  } while (joined && end_ < bytes_.size());
}

// Where the line that begins at `at` ends, with its break. The next LF and CR are kept, because a
// file may have only one of the two.
std::size_t Lines::find_break(std::size_t at) {
  if (line_feed_ < at) line_feed_ = std::min(bytes_.find('\n', at), bytes_.size());
  if (return_ < at) return_ = std::min(bytes_.find('\r', at), bytes_.size());
  const bool is_alone = return_ < line_feed_ && return_ + 1 != line_feed_;
  return std::min((is_alone ? return_ : line_feed_) + 1, bytes_.size());
}

bool Lines::is_joined(std::string_view line) const {
  const std::size_t last = line.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos || line[last] != '\\') return false;
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (at == 0 || is_blank(line[at - 1])) return false;  // a comment
  }
  return true;
}

void Lines::split() {
  tokens_.clear();
  const char joint = continued_ ? '\\' : ' ';
  const auto separates = [joint](char c) { return is_blank(c) || c == joint; };
  for (std::size_t at = begin_; at < end_;) {
    if (separates(bytes_[at])) {
      ++at;
      continue;
    }
    if (bytes_[at] == '#') return;
    std::size_t stop = at + 1;
    while (stop < end_ && !separates(bytes_[stop])) ++stop;
    tokens_.push_back({at, bytes_.substr(at, stop - at)});
    at = stop;
  }
}

std::size_t find_blank(std::string_view text, std::size_t at, bool blank) {
  while (at < text.size() && is_blank(text[at]) != blank) ++at;
  return std::min(at, text.size());
}

std::string quoted_ascii(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "...'" : "'");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == text.npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::optional<double> to_number(std::string_view word) { return to_real<double>(word); }

std::optional<float> to_float(std::string_view word) { return to_real<float>(word); }

std::optional<std::int64_t> to_integer(std::string_view word) {
  word = without_plus(word);
  const char* end = word.data() + word.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

}  // namespace deformlab
