#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "experiments/subjects/particles/particle_cache.h"
#include "geometry/core/files.h"

namespace deformlab {

/// Writes a copy of a cache with other coordinates, in the order of its rows. If the rows are in
/// the order of frames, the positions of a frame are written at once. Otherwise they are kept until
/// all are known.
class ParticleWriter {
 public:
  ParticleWriter(const ParticleCache& cache, const std::filesystem::path& out);

  /// `positions` is 3×#rows [length].
  void add(ParticleFrame rows, const Eigen::Matrix3Xd& positions);
  /// Throws InputError if not all could be written. Without `commit`, no file appears.
  void commit();

 private:
  void write(const Eigen::Vector3d& position);

  bool streams_;
  Eigen::Matrix3Xd kept_;  // the positions of all rows, if they are not written at once
  ParticleReader reader_;
  AtomicFile file_;
};

}  // namespace deformlab
