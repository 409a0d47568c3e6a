#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "experiments/subjects/animation/fingerprint.h"
#include "experiments/subjects/animation/frame_pattern.h"
#include "geometry/shape/shape.h"

namespace deformlab {

struct AnimationOptions;

/// The frames of a mesh animation. Each is made or read when it is asked for.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual FrameRange range() const = 0;
  virtual Shape read(FrameNumber frame) const = 0;
};

/// Frames in files.
class FrameFiles : public FrameSource {
 public:
  /// Messages call the pattern `name`. Throws InputError as FramePattern and find_frames do.
  FrameFiles(const std::string& pattern, const std::string& name);

  FrameRange range() const override { return range_; }
  Shape read(FrameNumber frame) const override;
  const FramePattern& pattern() const { return pattern_; }

  /// Reads all frames and adds them to the fingerprint. Throws InputError for a frame that cannot
  /// be read, and as FrameOrder does for one that has other vertices than those before.
  void check(Fingerprint& fingerprint) const;

 private:
  FramePattern pattern_;
  FrameRange range_;
};

/// The gallop that the options describe.
std::unique_ptr<FrameSource> generated_frames(const AnimationOptions& options);

}  // namespace deformlab
