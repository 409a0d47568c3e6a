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
  bool joined = continued_;
  end_ = begin_;
  do {
    const std::size_t line_break = bytes_.find('\n', end_);
    end_ = std::min(line_break, bytes_.size() - 1) + 1;
    ++next_number_;
    const std::string_view line = bytes_.substr(begin_, end_ - begin_);
    const std::size_t last = continued_ ? line.find_last_not_of("\r\n") : line.npos;
    joined = last != line.npos && line[last] == '\\';
  } while (joined && end_ < bytes_.size());
}

void Lines::split() {
  tokens_.clear();
  const auto separates = [this](char c) { return is_blank(c) || (continued_ && c == '\\'); };
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
