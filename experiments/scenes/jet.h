#pragma once

#include "experiments/subjects/particles/particle_cache.h"

namespace deformlab {

/// A jet of particles that leaves the origin along x, swirls about itself and widens: about 1,070
/// particles a frame. Ten are born in each, and each lives through 107 frames (fewer at the begin
/// and end of the animation, which starts with the jet already there). One of the ten goes straight
/// along the jet's middle, which may be bent: it turns upwards, by `bend` [degree] over its length.
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
