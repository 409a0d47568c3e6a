#include "experiments/subjects/animation/frame_loop.h"

#include <glog/logging.h>

#include "experiments/subjects/animation/progress_line.h"

namespace deformlab {

FrameLoop::FrameLoop(const FramePattern& out, const std::string& fingerprint)
    : resume_(out, fingerprint) {
  if (!resume_.outdated()) return;
  LOG(WARNING) << "a run was stopped before, but its frames or its edit were others: starting over";
}

void FrameLoop::run(const FrameRange& range, const std::function<bool(FrameNumber)>& make,
                    const std::function<void(FrameNumber)>& pass) {
  ProgressLine progress("animate: frame");
  for (FrameNumber i = 0; i < range.count(); ++i) {
    const FrameNumber frame = range.first + i;
    if (resume_.has(frame)) {
      ++passed_;
      pass(frame);
    } else {
      if (!make(frame)) return;
      ++made_;
      resume_.finished(frame);
    }
    progress.show(i + 1, range.count());
  }
}

}  // namespace deformlab
