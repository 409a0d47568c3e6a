#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// What the user holds of a shape (Sumner et al. 2007, section 4; Igarashi et al. 2005, section 3).
/// Where it goes is not here: targets change with every update, handles only with a compilation.
struct Handles {
  std::vector<int> fixed;  ///< vertices that stay: nodes that influence one are held at rest
  std::vector<int> moved;  ///< vertices that move, index(l) of Eq. 8, in the order of the targets
  /// 3×p places inside the shape that need be no vertices [length]; their targets follow those of
  /// `moved`. Of a drawing z is 0. Where a graph has cuts or distances along a surface, a place
  /// follows the nodes of the vertex nearest to it.
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 0);

  Eigen::Index targets() const { return static_cast<Eigen::Index>(moved.size()) + points.cols(); }
};

}  // namespace deformlab
