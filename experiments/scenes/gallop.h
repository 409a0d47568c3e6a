#pragma once

#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// A quadruped that gallops on the spot. The x axis points forward, y to its left, and z up. It is
/// about 2.7 long and 1.9 high. Its skin is one closed mesh around a skeleton, and each frame poses
/// the skeleton.
class Gallop {
 public:
  /// `cell` is the mean distance of the mesh's vertices [length].
  explicit Gallop(double cell);

  Eigen::Index vertices() const { return rest_.V.cols(); }
  /// The pose at a time, in gait cycles. In addition to the gait, the head bobs at five times the
  /// frequency.
  Shape pose(double time) const;

 private:
  Shape rest_;                 // standing
  Eigen::MatrixXd influence_;  // #joints × #V, the sum of each column is 1
};

}  // namespace deformlab
