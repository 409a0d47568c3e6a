#pragma once

#include <functional>
#include <optional>
#include <string>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/animation/resume_file.h"

namespace deformlab {

/// The loop over the frames of an animation, each of which gets a file. It shows its progress, and
/// goes on where a run that was stopped ended.
class FrameLoop {
 public:
  /// Throws InputError as ResumeFile does.
  FrameLoop(const FramePattern& out, const std::string& fingerprint);

  /// Calls, in the order of frames, `pass` for each frame that an earlier run has made, and `make`,
  /// which writes its file, for each other. Ends where `make` returns false.
  void run(const FrameRange& range, const std::function<bool(FrameNumber)>& make,
           const std::function<void(FrameNumber)>& pass);
  /// Has to be called when all frames are complete.
  void complete() { resume_.remove(); }

  int made() const { return made_; }      ///< frames that this run made
  int passed() const { return passed_; }  ///< frames that an earlier run made

 private:
  ResumeFile resume_;
  int made_ = 0, passed_ = 0;
};

}  // namespace deformlab
