#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/subjects/animation/frame_pattern.h"

namespace deformlab {

inline constexpr const char* kProgressEnding = ".progress";  ///< after the output's pattern

/// A small file beside the output of a run over a sequence. It says which frames are finished, so
/// that a run that was stopped can continue. It is removed after the last frame.
class ResumeFile {
 public:
  /// Reads the file of an earlier run, but ignores it if its fingerprint differs, because that run
  /// had another input or edit. Removes incomplete files of the earlier run.
  ResumeFile(const FramePattern& out, std::string fingerprint);

  bool outdated() const {
    return outdated_;
  }  ///< whether there was a file with another fingerprint
  /// Whether the earlier run finished a frame, and its file is still there.
  bool has(int frame) const;
  /// Has to be called when the file of a frame is complete. Throws InputError if the resume file
  /// cannot be written.
  void finished(int frame);
  void remove();  ///< has to be called when all frames are complete

 private:
  void read();

  const FramePattern& out_;
  std::filesystem::path path_;
  std::string fingerprint_;
  std::optional<int> last_;
  bool outdated_ = false;
};

}  // namespace deformlab
