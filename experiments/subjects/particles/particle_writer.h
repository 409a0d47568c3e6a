#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "experiments/subjects/particles/particle_cache.h"
#include "geometry/core/files.h"

namespace deformlab {

/// Writes a copy of a cache with other coordinates, in the order of its rows. The edited positions
/// of a frame go to the file at once where the rows are in the order of frames; otherwise they are
/// kept until all are there.
class ParticleWriter {
 public:
  ParticleWriter(const ParticleCache& cache, const std::filesystem::path& out);

  /// `positions` is 3×#rows [length].
  void add(ParticleFrame rows, const Eigen::Matrix3Xd& positions);
  /// Throws InputError where not all could be written. Without it, no file appears.
  void commit();

 private:
  void write(const Eigen::Vector3d& position);

  bool streams_;
  Eigen::Matrix3Xd kept_;  // of all rows, where they do not stream
  ParticleReader reader_;
  AtomicFile file_;
};

}  // namespace deformlab
