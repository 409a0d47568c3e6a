#include "experiments/subjects/animation/frame_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "experiments/config/suggest.h"
#include "geometry/core/error.h"

namespace deformlab {
namespace {

namespace fs = std::filesystem;

bool same_folder(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

FramePattern::FramePattern(const std::string& text, const std::string& pattern_name)
    : text_(text),
      description_(pattern_name + " " + quote(text)),
      parent_(fs::path(text).parent_path()) {
  const std::string name = fs::path(text).filename().string();
  const std::string expected = description_ +
                               ": it needs one %d for the frame's number in the file's name, or "
                               "%03d for one of three digits: 'horse-%03d.obj'";
  if (std::ranges::count(text, '%') != 1) throw InputError(expected);
  const std::size_t begin = name.find('%');
  if (begin == std::string::npos) throw InputError(expected);
  const std::size_t end = name.find_first_not_of("0123456789", begin + 1);
  const std::string digits = name.substr(begin + 1, end - begin - 1);
  const bool padded = digits.size() == 2 && digits[0] == '0' && digits[1] > '0';
  if (end == std::string::npos || name[end] != 'd' || !(digits.empty() || padded)) {
    throw InputError(expected);
  }
  prefix_ = name.substr(0, begin);
  suffix_ = name.substr(end + 1);
  width_ = padded ? static_cast<std::size_t>(digits[1] - '0') : 1;
}

fs::path FramePattern::folder() const { return parent_.empty() ? fs::path(".") : parent_; }

fs::path FramePattern::path(FrameNumber frame) const {
  const std::string number = std::to_string(frame);
  const std::string zeros(width_ > number.size() ? width_ - number.size() : 0, '0');
  return parent_ / (prefix_ + zeros + number + suffix_);
}

std::optional<FrameNumber> FramePattern::frame_of(const std::string& filename) const {
  if (!filename.starts_with(prefix_) || !filename.ends_with(suffix_)) return {};
  if (filename.size() <= prefix_.size() + suffix_.size()) return {};
  const std::string number =
      filename.substr(prefix_.size(), filename.size() - prefix_.size() - suffix_.size());
  if (!std::ranges::all_of(number, is_digit)) return {};
  FrameNumber frame = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), frame);
  if (error != std::errc()) return {};
  if (path(frame).filename() != filename) return {};
  return frame;
}

FrameNumber FrameRange::count() const {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<FrameNumber>::max());
  const auto steps = static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first);
  return static_cast<FrameNumber>(steps < kMost ? steps + 1 : kMost);
}

FrameRange find_frames(const FramePattern& pattern) {
  std::error_code error;
  std::optional<FrameRange> range;
  FrameNumber found = 0;
  for (const auto& entry : fs::directory_iterator(pattern.folder(), error)) {
    const std::optional<FrameNumber> frame = pattern.frame_of(entry.path().filename().string());
    if (!frame) continue;
    if (!range) range = {*frame, *frame};
    range = {std::min(range->first, *frame), std::max(range->last, *frame)};
    ++found;
  }
  if (!range) {
    throw InputError(fmt::format("no file matches {}; the first could be {}", pattern.description(),
                                 quote(pattern.path(0).string())));
  }
  for (FrameNumber frame = range->first; found < range->count(); ++frame) {
    if (fs::exists(pattern.path(frame), error)) continue;
    throw InputError(fmt::format("frame {} is missing: there is no {}, but there are {} and {}",
                                 frame, quote(pattern.path(frame).string()),
                                 quote(pattern.path(range->first).string()),
                                 quote(pattern.path(range->last).string())));
  }
  return *range;
}

void check_no_frame(const std::string& path, const std::string& flag, const FramePattern& pattern) {
  const fs::path file(path);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (path.empty() || !pattern.frame_of(file.filename().string())) return;
  if (!same_folder(folder, pattern.folder())) return;
  throw InputError(fmt::format("{} {} is the name of a frame of {}; name another file", flag,
                               quote(path), pattern.description()));
}

void check_apart(const FramePattern& in, const FramePattern& out, const FrameRange& range) {
  if (!same_folder(in.folder(), out.folder())) return;
  for (FrameNumber i = 0; i < range.count(); ++i) {
    const FrameNumber frame = range.first + i;
    const fs::path written = out.path(frame);
    if (!in.frame_of(written.filename().string())) continue;
    throw InputError(fmt::format("{} would write {}, which {} reads; name other files",
                                 out.description(), quote(written.string()), in.description()));
  }
}

}  // namespace deformlab
