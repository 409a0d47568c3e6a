#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/subjects/animation/frame_pattern.h"
#include "geometry/core/file_lock.h"

namespace deformlab {

inline constexpr const char* kProgressEnding = ".progress";  ///< after the output's pattern

/// A small file beside the output of a run over a sequence. It has a line for each frame that is
/// finished, with the size and the hash of the frame's file, so that a run that was stopped can
/// continue. It is removed after the last frame. Two runs that write one sequence wait for each
/// other.
class ResumeFile {
 public:
  /// Reads the file of an earlier run, but ignores it if its fingerprint differs, because that run
  /// had another input or edit. Throws InputError if the file cannot be written.
  ResumeFile(const FramePattern& out, std::string fingerprint);
  ~ResumeFile();
  ResumeFile(const ResumeFile&) = delete;
  ResumeFile& operator=(const ResumeFile&) = delete;

  /// Whether there was a file with another fingerprint.
  bool outdated() const { return outdated_; }
  /// Whether the earlier run finished a frame, and its file is still there as that run wrote it.
  bool has(FrameNumber frame) const;
  /// Has to be called when the file of a frame is complete. Throws InputError if the resume file
  /// cannot be written.
  void finished(FrameNumber frame);
  /// Has to be called when all frames are complete. Throws InputError if the file cannot be
  /// removed.
  void remove();

 private:
  struct Written {
    std::uintmax_t size = 0;
    std::string hash;
  };

  void go_on(const std::string& text);
  void read(std::string_view text);
  void begin();
  void append(const std::string& text);
  Written written(FrameNumber frame) const;

  const FramePattern& out_;
  std::filesystem::path path_;
  std::string fingerprint_;
  std::optional<FileLock> file_;
  std::map<FrameNumber, Written> frames_;
  bool outdated_ = false, done_ = false;
};

}  // namespace deformlab
