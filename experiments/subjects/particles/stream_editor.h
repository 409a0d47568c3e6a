#pragma once

#include <optional>

#include "deformers/embedded/stream_deformation.h"
#include "experiments/subjects/motion/handle_motion.h"
#include "experiments/subjects/particles/particle_cache.h"

namespace deformlab {

/// Edits particles frame by frame. Selections select nodes along the sampled path; `point` selects
/// any position. The solver runs only in frames where the offsets have changed.
class StreamEditor {
 public:
  /// `path` is the id of the particle whose path is sampled; by default find_path chooses one.
  /// Throws InputError for options and edits that are not possible for particles.
  StreamEditor(const ParticleSource& particles, const Script& script,
               const EmbeddedDeformationOptions& options, std::optional<std::int64_t> path);

  /// The edited positions of the particles of a frame, 3×#rows [length].
  Eigen::Matrix3Xd edited(FrameNumber frame, ParticleFrame rows);
  const Report& report() const { return report_; }  ///< of the last solve
  /// The seconds of the last frame without a solve: for the weights of its particles, and for their
  /// transfer by Eq. 2.
  struct Seconds {
    double weights = 0, transfer = 0;
  };
  const Seconds& seconds() const { return seconds_; }
  int solves() const { return solves_; }  ///< how often the solver ran
  Eigen::Matrix3Xd handles() const {
    return rest_ + offsets_;
  }  ///< their targets in the last frame
  double worst_handle() const { return worst_handle_; }
  const ParticleLife& life() const { return life_; }
  int nodes() const { return static_cast<int>(stream_.path().V.cols()); }
  const StreamDeformation& stream() const { return stream_; }
  const HandleMotion& motion() const { return motion_; }

 private:
  void solve(const Eigen::Matrix3Xd& offsets, const Eigen::Matrix3Xd& rotations);

  ParticleLife life_;
  StreamDeformation stream_;
  HandleMotion motion_;
  Eigen::Matrix3Xd rest_, offsets_, rotations_;  // of the handles
  Report report_;
  Seconds seconds_;
  double worst_handle_ = 0;
  int solves_ = 0;
};

}  // namespace deformlab
