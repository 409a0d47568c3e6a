#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/subjects/animation/frame_pattern.h"

namespace deformlab {

inline constexpr const char* kProgressEnding = ".progress";  ///< after the output's pattern

/// How far a run over a sequence has come, in a small file beside its output, so that one that was
/// stopped goes on from there. It goes away with the last frame.
class ResumeFile {
 public:
  /// Reads what an earlier run left. Where that was made from something else, as the fingerprint
  /// tells, it counts for nothing. Half-written files that it left behind are removed.
  ResumeFile(const FramePattern& out, std::string fingerprint);

  bool outdated() const { return outdated_; }  ///< there was one, of another input or edit
  /// Whether the earlier run finished a frame, which is still there.
  bool has(int frame) const;
  void finished(int frame);  ///< once its file is whole. Throws InputError where it cannot be told
  void remove();             ///< all frames are there

 private:
  void read();

  const FramePattern& out_;
  std::filesystem::path path_;
  std::string fingerprint_;
  std::optional<int> last_;
  bool outdated_ = false;
};

}  // namespace deformlab
