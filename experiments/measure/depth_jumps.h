#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>

#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// Counts where the order in depth changes from one frame of an animation to the next. Frames are
/// added one after the other.
class DepthJumps {
 public:
  /// The overlaps of a frame, and the depth of each triangle (#F, higher is nearer).
  void add(const Overlaps& overlaps, const Eigen::VectorXd& depths);

  /// Pairs of triangles that overlapped in two consecutive frames, of which one was in front in the
  /// first and the other one in the second, over all frames.
  int count() const { return count_; }

 private:
  std::map<std::pair<int, int>, bool> first_in_front_;  // of each pair a < b in the last frame
  int count_ = 0;
};

}  // namespace deformlab
