#pragma once

#include "experiments/subjects/particles/particle_cache.h"

namespace deformlab {

/// A jet of particles that leaves the origin along x, swirls about its axis and widens. Ten
/// particles are born in each frame, and each lives through 107 frames, so that a frame has 1,070.
/// The jet exists already in the first frame, so lives at the begin and at the end of the animation
/// are shorter. One of the ten moves along the middle of the jet. The middle turns upwards by
/// `bend` [degree] over its length.
class Jet : public ParticleSource {
 public:
  explicit Jet(int frames, double bend = 0) : frames_(frames), bend_(bend) {}
  void for_each_frame(const Visit& visit) const override;
  FrameRange frames() const override { return {0, frames_ - 1}; }
  std::string name() const override { return "the jet"; }

 private:
  int frames_;
  double bend_;
};

}  // namespace deformlab
