#pragma once

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// Embedded deformation of a stream of particles (Sumner et al. 2007, section 5, "Particle
/// simulations"). The graph is a chain of samples of the path that one particle takes. It does not
/// move with the particles, and a particle follows the nodes that it is near to at the moment. The
/// paper's energy does not prevent such a chain from rotating about itself: if the path is curved
/// at rest and bent in another direction, the minimum rotates it until both curvatures agree. The
/// energy term `smoothness` prevents that.
class StreamDeformation {
 public:
  /// `samples` is 3×m, in the order of time [length]. Throws InputError for options out of range
  /// and for no samples.
  StreamDeformation(const Eigen::Matrix3Xd& samples, const EmbeddedDeformationOptions& options);

  /// The nodes as points without faces, from which handles are chosen. Handles may also be points
  /// beside the nodes.
  const Shape& path() const { return path_; }
  void compile(const Handles& handles) { deformation_.compile(handles); }
  Report update(const Eigen::Matrix3Xd& targets) { return deformation_.update(targets); }
  void reset() { deformation_.reset(); }

  /// The deformed positions (3×n) of particles at these positions (3×n, n ≥ 0) [length] by Eq. 2.
  /// Their influences are the weights of Eq. 4.
  Eigen::Matrix3Xd deformed(const Eigen::Matrix3Xd& positions) const {
    return deformed(influences(positions));
  }
  Embedding influences(const Eigen::Matrix3Xd& positions) const;
  Eigen::Matrix3Xd deformed(const Embedding& particles) const;
  /// The blended matrices Σ_j w_j R_j at each position, side by side (3×3n).
  Eigen::Matrix3Xd rotations(const Eigen::Matrix3Xd& positions) const;
  const EmbeddedDeformation& deformation() const { return deformation_; }

 private:
  Shape path_;
  int neighbors_;
  EmbeddedDeformation deformation_;
};

}  // namespace deformlab
