#pragma once

#include <functional>
#include <span>

#include "experiments/subjects/animation/frame_pattern.h"
#include "experiments/subjects/particles/particle_rows.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// The particles of one frame in the order of their rows.
using ParticleFrame = std::span<const ParticleRow>;

/// The positions of a frame's particles, 3×#rows [length].
Eigen::Matrix3Xd positions_of(ParticleFrame rows);

/// A shape that has only points, at `positions` (3×n) [length].
Shape as_points(const Eigen::Matrix3Xd& positions);

/// Particles that come and go, frame by frame.
class ParticleSource {
 public:
  using Visit = std::function<void(FrameNumber frame, ParticleFrame)>;

  virtual ~ParticleSource() = default;
  /// Calls `visit` for each frame that has particles, in order of time.
  virtual void for_each_frame(const Visit& visit) const = 0;
  virtual FrameRange frames() const = 0;
  virtual std::string name() const = 0;  ///< what messages call it
};

/// A particle cache in a file. If its rows are in the order of frames, they are read when they are
/// needed, so that memory does not grow with their number. Otherwise all are kept in memory.
class ParticleCache : public ParticleSource {
 public:
  /// Reads the whole file once. Throws InputError as ParticleReader does, for a file without rows,
  /// and for an id that occurs twice in a frame (naming both lines).
  explicit ParticleCache(std::filesystem::path path);

  void for_each_frame(const Visit& visit) const override;
  std::string name() const override { return "'" + path_.string() + "'"; }
  FrameRange frames() const override { return frames_; }
  std::int64_t rows() const { return rows_; }
  bool streams() const { return kept_.empty(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  void stream(const Visit& visit) const;
  void keep();
  void check_ids(ParticleFrame frame) const;

  std::filesystem::path path_;
  FrameRange frames_;
  std::int64_t rows_ = 0;
  std::vector<ParticleRow> kept_;  // all rows sorted by frame, if the file is not sorted
};

/// Consecutive frames in which a particle lives.
struct ParticleLife {
  std::int64_t id = 0;
  FrameNumber first = 0, last = 0;
  Eigen::Vector3d begin{0, 0, 0}, end{0, 0, 0};  ///< [length]
  double travelled = 0;                          ///< length of the path between [length]
};

/// The life whose path carries the graph. With an `id`, it is the longest life of that particle.
/// Otherwise, of the particles that live longest, it is the one with the straightest path (the
/// distance from its begin to its end, over the length of its path), because it is in the middle of
/// a stream that swirls. Throws InputError if there is no such particle, or if it never moves.
ParticleLife find_path(const ParticleSource& particles, std::optional<std::int64_t> id);

/// m samples of a particle's path at equal intervals of time, 3×m [length]. Between two frames the
/// path is straight.
Eigen::Matrix3Xd sample_path(const ParticleSource& particles, const ParticleLife& life, int m);

}  // namespace deformlab
