#include "experiments/subjects/animation/frame_source.h"

#include <glog/logging.h>

#include "experiments/scenes/gallop.h"
#include "experiments/subjects/animation/animation_options.h"
#include "experiments/subjects/animation/frame_order.h"
#include "experiments/subjects/animation/progress_line.h"
#include "geometry/shape/shape_io.h"

namespace deformlab {
namespace {

class GallopFrames : public FrameSource {
 public:
  explicit GallopFrames(const AnimationOptions& options)
      : gallop_(options.cell), frames_(options.frames), cycle_(options.cycle) {}

  FrameRange range() const override { return {0, frames_ - 1}; }
  Shape read(FrameNumber frame) const override {
    return gallop_.pose(static_cast<double>(frame) / cycle_);
  }

 private:
  Gallop gallop_;
  int frames_;
  double cycle_;
};

}  // namespace

FrameFiles::FrameFiles(const std::string& pattern, const std::string& name)
    : pattern_(pattern, name), range_(find_frames(pattern_)) {}

Shape FrameFiles::read(FrameNumber frame) const { return read_shape(pattern_.path(frame)); }

void FrameFiles::check(Fingerprint& fingerprint) const {
  std::vector<std::string> notes;  // of the first frame, which the others resemble
  read_shape(pattern_.path(range_.first), &notes);
  for (const std::string& note : notes) LOG(WARNING) << note;
  FrameOrder order;
  ProgressLine progress("animate: checked frame");
  for (FrameNumber i = 0; i < range_.count(); ++i) {
    const FrameNumber frame = range_.first + i;
    order.add(read(frame), frame, pattern_.path(frame));
    fingerprint.add_file(pattern_.path(frame));
    progress.show(i + 1, range_.count());
  }
}

std::unique_ptr<FrameSource> generated_frames(const AnimationOptions& options) {
  return std::make_unique<GallopFrames>(options);
}

}  // namespace deformlab
