#pragma once

#include <optional>

#include "deformers/embedded/stream_deformation.h"
#include "experiments/subjects/animation/handle_motion.h"
#include "experiments/subjects/particles/particle_cache.h"

namespace deformlab {

/// Edits particles frame by frame. Selections speak of the nodes along the sampled path, and
/// `point` of any place; the solver is asked again only where the offsets have changed.
class StreamEditor {
 public:
  /// `path` is the id of the particle whose path is sampled; without one it is chosen. Throws
  /// InputError where the options or the edit do not fit.
  StreamEditor(const ParticleSource& particles, const Script& script,
               const EmbeddedDeformationOptions& options, std::optional<std::int64_t> path);

  /// Where the particles of a frame go, 3×#rows [length].
  Eigen::Matrix3Xd edited(int frame, ParticleFrame rows);
  const Report& report() const { return report_; }  ///< of the last solve
  /// What the last frame took, beside a solve: its particles' weights, and their transfer by Eq. 2.
  struct Seconds {
    double weights = 0, transfer = 0;
  };
  const Seconds& seconds() const { return seconds_; }
  int solves() const { return solves_; }                         ///< how often the solver was asked
  Eigen::Matrix3Xd handles() const { return rest_ + offsets_; }  ///< where they should be now
  double worst_handle() const { return worst_handle_; }
  const ParticleLife& life() const { return life_; }
  int nodes() const { return static_cast<int>(stream_.path().V.cols()); }
  const StreamDeformation& stream() const { return stream_; }
  const HandleMotion& motion() const { return motion_; }

 private:
  void solve(const Eigen::Matrix3Xd& offsets);

  ParticleLife life_;
  StreamDeformation stream_;
  HandleMotion motion_;
  Eigen::Matrix3Xd rest_, offsets_;  // of the handles
  Report report_;
  Seconds seconds_;
  double worst_handle_ = 0;
  int solves_ = 0;
};

}  // namespace deformlab
