#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace deformlab {

/// The number of a frame. All 64-bit integers are allowed.
using FrameNumber = std::int64_t;

/// How many frames lie between two, rounded where there are more than 2⁵³.
inline double frames_between(FrameNumber from, FrameNumber to) {
  return static_cast<double>(static_cast<long double>(to) - static_cast<long double>(from));
}

/// The files of a sequence, one for each frame: `horse-%03d.obj` stands for horse-000.obj,
/// horse-001.obj and so on.
class FramePattern {
 public:
  /// Messages call it `pattern_name`. Throws InputError if the text does not have exactly one %d or
  /// %0Nd, or has it in the name of a folder.
  FramePattern(const std::string& text, const std::string& pattern_name);

  std::filesystem::path path(FrameNumber frame) const;
  /// The frame that a file of this name belongs to, if the pattern matches it.
  std::optional<FrameNumber> frame_of(const std::string& filename) const;

  const std::string& text() const { return text_; }
  /// "--frames 'horse-%03d.obj'"
  const std::string& description() const { return description_; }
  std::filesystem::path folder() const;

 private:
  std::string text_, description_;
  std::string prefix_, suffix_;  // of the file's name
  std::size_t width_ = 0;
  std::filesystem::path parent_;
};

/// The numbers of the frames of a sequence, from the first to the last.
struct FrameRange {
  FrameNumber first = 0, last = 0;
  /// At most the greatest number of a frame, although a range of all numbers has more.
  FrameNumber count() const;
};

/// All frames that the pattern matches. Throws InputError if there is none, or if one is missing
/// between two others (naming it).
FrameRange find_frames(const FramePattern& pattern);

/// Throws InputError if a file that is written would also be read, in this or in another run.
void check_apart(const FramePattern& in, const FramePattern& out, const FrameRange& range);

/// Throws InputError if the pattern matches the file that `flag` names, whether this file exists or
/// not. The path may be empty.
void check_no_frame(const std::string& path, const std::string& flag, const FramePattern& pattern);

}  // namespace deformlab
