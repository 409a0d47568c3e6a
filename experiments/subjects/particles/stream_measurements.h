#pragma once

#include <unordered_map>

#include "deformers/embedded/stream_deformation.h"
#include "experiments/measure/measurements.h"
#include "experiments/subjects/particles/particle_cache.h"

namespace deformlab {

/// Compares the velocities of edited particles with those of the input. u and ũ are the vectors by
/// which a particle moves from one frame to the next in the input and in the output:
///   frames                    number of frames that have particles
///   particles, born, died     mean number in a frame
///   speed_ratio               Σ |ũ| / Σ |u|
///   speed_correlation         Pearson's correlation of |ũ| and |u|; missing if all speeds are the
///                             same
///   velocity_error            root mean square of ũ − R u over that of u, where R is the rotation
///                             nearest to Σ_j w_j R_j at the particle: 0 if particles
///                             flow in the bent stream as they did in the straight one
///   velocity_change           the same without R: how much the edit changed the direction of flow
class StreamMeasurements {
 public:
  void add(const StreamDeformation& stream, ParticleFrame rows, const Eigen::Matrix3Xd& edited);
  Metrics metrics() const;

 private:
  struct Particle {
    Eigen::Vector3d position, edited;
    Eigen::Matrix3d R;
  };
  void compare(const Particle& before, const Particle& now);

  std::unordered_map<std::int64_t, Particle> last_;
  double particles_ = 0, born_ = 0, died_ = 0, frames_ = 0, pairs_ = 0;
  double u_ = 0, w_ = 0, uu_ = 0, ww_ = 0, uw_ = 0, turned_off_ = 0, off_ = 0;
};

/// Measures the twist of the chain of nodes. For each edge, let Q_j and Q_k be the rotations
/// nearest to R_j and R_k. The twist of the edge is the angle of Q_k Q_jᵀ about the direction of
/// the deformed edge [degree].
///   twist      the sum of absolute values along the chain
///   twist_max  the greatest absolute value
Metrics twist_of(const StreamDeformation& stream);

}  // namespace deformlab
