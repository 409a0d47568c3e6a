#pragma once

#include <functional>
#include <span>

#include "experiments/animation/frame_pattern.h"
#include "experiments/animation/particle_rows.h"

namespace deformlab {

/// The particles of one frame in the order of their rows.
using ParticleFrame = std::span<const ParticleRow>;

/// A particle cache, frame by frame. Where its rows are in the order of frames they are read as
/// they are needed, and memory does not grow with their number; otherwise all are kept.
class ParticleCache {
 public:
  /// Reads the whole once. Throws InputError as ParticleReader does, without a row, and for an id
  /// that occurs twice in a frame (naming both lines).
  explicit ParticleCache(std::filesystem::path path);

  /// Calls `visit` for each frame that has particles, in order of time.
  void for_each_frame(const std::function<void(int frame, ParticleFrame)>& visit) const;

  const std::filesystem::path& path() const { return path_; }
  FrameRange frames() const { return frames_; }
  std::int64_t rows() const { return rows_; }
  bool streams() const { return kept_.empty(); }

 private:
  void stream(const std::function<void(int, ParticleFrame)>& visit) const;
  void keep();
  void check_ids(ParticleFrame frame) const;

  std::filesystem::path path_;
  FrameRange frames_;
  std::int64_t rows_ = 0;
  std::vector<ParticleRow> kept_;  // by frame, where the file is not
};

/// A stretch of frames through which a particle lives.
struct ParticleLife {
  std::int64_t id = 0;
  int first = 0, last = 0;
  Eigen::Vector3d begin{0, 0, 0}, end{0, 0, 0};  ///< [length]
};

/// Of the particles that live longest the one that goes farthest; with an `id`, the longest life of
/// that one. Throws InputError where no such particle occurs, or it never moves.
ParticleLife find_path(const ParticleCache& cache, std::optional<std::int64_t> id);

/// m samples of a particle's path at equal intervals of time, 3×m [length]; between two frames it
/// goes straight.
Eigen::Matrix3Xd sample_path(const ParticleCache& cache, const ParticleLife& life, int m);

}  // namespace deformlab
