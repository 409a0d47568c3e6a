#pragma once

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// Embedded deformation of a stream of particles (Sumner et al. 2007, section 5, "Particle
/// simulations"): the graph is a chain of samples of the path that one particle takes. It stands in
/// space, and particles that come through are under the influence of the nodes they are near to.
/// Nothing in the paper's energy says how far such a chain may turn about itself: where the path is
/// curved at rest, and is bent another way, its minimum turns it so that both curvatures agree. The
/// energy term `smoothness` keeps it from that.
class StreamDeformation {
 public:
  /// `samples` is 3×m, in order of time [length]. Throws InputError for options out of range and
  /// without a sample.
  StreamDeformation(const Eigen::Matrix3Xd& samples, const EmbeddedDeformationOptions& options);

  /// The nodes as points without faces: what handles are chosen from. They may be places too.
  const Shape& path() const { return path_; }
  void compile(const Handles& handles) { deformation_.compile(handles); }
  Report update(const Eigen::Matrix3Xd& targets) { return deformation_.update(targets); }
  void reset() { deformation_.reset(); }

  /// Where particles (3×n, n ≥ 0) go that are at `places` now [length]: their weights, Eq. 4, and
  /// by these Eq. 2.
  Eigen::Matrix3Xd deformed(const Eigen::Matrix3Xd& places) const {
    return deformed(influences(places));
  }
  Embedding influences(const Eigen::Matrix3Xd& places) const;
  Eigen::Matrix3Xd deformed(const Embedding& particles) const;
  /// Σ_j w_j R_j at each place, side by side, 3×3n: how space is turned there.
  Eigen::Matrix3Xd turns(const Eigen::Matrix3Xd& places) const;
  const EmbeddedDeformation& deformation() const { return deformation_; }

 private:
  Shape path_;
  int neighbors_;
  EmbeddedDeformation deformation_;
};

}  // namespace deformlab
