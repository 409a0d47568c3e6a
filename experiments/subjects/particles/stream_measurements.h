#pragma once

#include <unordered_map>

#include "deformers/embedded/stream_deformation.h"
#include "experiments/measure/measurements.h"
#include "experiments/subjects/particles/particle_cache.h"

namespace deformlab {

/// Pins the velocities of edited particles against those of the input. With u and ũ the way of a
/// particle from one frame to the next in both:
///   frames                    in which there are particles
///   particles, born, died     mean a frame
///   speed_ratio               Σ |ũ| / Σ |u|
///   speed_correlation         Pearson's, of |ũ| and |u|; nothing where all are as fast
///   velocity_error            root mean square of ũ − R u over that of u, R the rotation nearest
///                             to what the graph does to space at the particle: 0 where the
///                             particle flows in the bent stream as it did in the straight one
///   velocity_change           the same without R: how much the edit changed the stream's course
class StreamMeasurements {
 public:
  void add(const StreamDeformation& stream, ParticleFrame rows, const Eigen::Matrix3Xd& edited);
  Metrics metrics() const;

 private:
  struct Particle {
    Eigen::Vector3d place, edited;
    Eigen::Matrix3d R;
  };
  void compare(const Particle& before, const Particle& now);

  std::unordered_map<std::int64_t, Particle> last_;
  double particles_ = 0, born_ = 0, died_ = 0, frames_ = 0, pairs_ = 0;
  double u_ = 0, w_ = 0, uu_ = 0, ww_ = 0, uw_ = 0, turned_off_ = 0, off_ = 0;
};

/// How the chain of nodes turns about itself. Of each edge the angle, about the edge where it is
/// now, of the rotation that takes the one nearest to R_j to that of its neighbour [degree]:
///   twist      the sum of its absolute values along the chain
///   twist_max  the greatest
Metrics twist_of(const StreamDeformation& stream);

}  // namespace deformlab
