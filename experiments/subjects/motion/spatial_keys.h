#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "experiments/subjects/shape/edit_motion.h"

namespace deformlab {

/// Weights of key poses that are tied to points of the plane, at any place of it (Igarashi,
/// Moscovich and Hughes 2005, "Spatial keyframing for performance-driven animation"). They are
/// those of interpolation by radial basis functions with the kernel |r| and an affine part. Where
/// the points lie on a line, or are two, the affine part only varies along it.
class SpatialKeys {
 public:
  /// The points of the poses, 2×n [length]. They are two or more, and no two are the same.
  explicit SpatialKeys(const Eigen::Matrix2Xd& points);

  /// One weight for each pose. Their sum is 1. At a point, its own pose has the weight 1 and all
  /// others have 0.
  Eigen::VectorXd weights(const Eigen::Vector2d& place) const;

 private:
  Eigen::VectorXd terms(const Eigen::Vector2d& place) const;

  Eigen::Matrix2Xd points_;  // relative to their centroid, and to their extent
  Eigen::Vector2d centroid_;
  double extent_;
  Eigen::Matrix2Xd axes_;  // 2×k, along which the points differ
  Eigen::FullPivLU<Eigen::MatrixXd> system_;
};

/// The weighted mean of poses in the plane. Angles are blended as rotations: the mean of unit
/// vectors in their directions gives the direction. Where these cancel each other, the angle is
/// that of the pose with the greatest weight. Each pose is met exactly, but for whole turns.
PoseNumbers blended(const std::vector<PoseNumbers>& poses, const Eigen::VectorXd& weights);

}  // namespace deformlab
