#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace deformlab {

/// The files of a sequence, one a frame: `horse-%03d.obj` stands for horse-000.obj, horse-001.obj …
class FramePattern {
 public:
  /// Throws InputError where the text has not exactly one %d or %0Nd, or has it in a folder's name;
  /// `flag` is what messages call it.
  FramePattern(const std::string& text, const std::string& flag);

  std::filesystem::path path(int frame) const;
  /// The frame that a file of this name would be, if it would be one.
  std::optional<int> frame_of(const std::string& filename) const;

  const std::string& text() const { return text_; }
  std::filesystem::path folder() const;

 private:
  std::string text_, prefix_, suffix_;  // of the file's name
  std::size_t width_ = 0;
  std::filesystem::path parent_;
};

/// The frames of a sequence, all that there are between the first and the last.
struct FrameRange {
  int first = 0, last = 0;
  int count() const { return last - first + 1; }
};

/// All frames that the pattern matches. Throws InputError where there is none, or one is missing
/// between two others (naming it).
FrameRange find_frames(const FramePattern& pattern);

/// Throws InputError where what is written would be, now or in another run, among what is read.
void check_apart(const FramePattern& in, const FramePattern& out, const FrameRange& range);

/// Throws InputError where a file that `flag` names would be one of the frames that the pattern, of
/// `pattern_flag`, stands for, be it there or not. The path may be empty.
void check_no_frame(const std::string& path, const std::string& flag, const FramePattern& pattern,
                    const std::string& pattern_flag);

}  // namespace deformlab
