#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace deformlab {

/// A connected region of the plane: simple closed polygons, 2×n corners without the first repeated.
struct Region {
  Eigen::Matrix2Xd outline;             ///< [length]
  std::vector<Eigen::Matrix2Xd> holes;  ///< inside the outline, apart from each other
};

}  // namespace deformlab
