#pragma once

#include <Eigen/Core>
#include <vector>

namespace deformlab {

/// The handles of a shape (Sumner et al. 2007, section 4; Igarashi et al. 2005, section 3). They
/// contain no targets, because targets change with every update, handles only with a compilation.
struct Handles {
  std::vector<int> fixed;  ///< vertices that stay; the nodes that influence them stay at rest
  std::vector<int> moved;  ///< vertices with targets, index(l) of Eq. 8, in the targets' order
  /// 3×p points inside the shape that need not be vertices [length]; z is 0 in a drawing. Their
  /// targets follow those of `moved`. Where a graph has cuts or distances along the surface, a
  /// point follows the nodes of the nearest vertex.
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 0);

  /// 3×targets() rotation vectors (unit axis times angle [rad]) by which the surroundings of the
  /// handles turn on their way, in the order of the targets. An angle may exceed a half turn: it is
  /// not reduced by full turns. A column is 0 where a handle is translated, and NaN where nothing
  /// is known about its rotation, as for a single vertex that goes somewhere. The whole is 3×0
  /// where no handle is known to turn; rotations can then be fitted to the targets of each group.
  /// Targets say where a handle ends; this says how it gets there. Where the handles of a group lie
  /// on a line, their targets do not tell its rotation about this line, so that this does.
  Eigen::Matrix3Xd rotations = Eigen::Matrix3Xd(3, 0);
  /// One number for each target: handles with the same number move together as one region. For an
  /// edit these are its entries, counted from 0. Empty: each handle moves by itself.
  std::vector<int> groups{};
  /// The weight of each target in E_con, Eq. 8, above 0. Empty: all are 1. Methods that hold
  /// handles exactly take none.
  Eigen::VectorXd weights{};

  Eigen::Index targets() const { return static_cast<Eigen::Index>(moved.size()) + points.cols(); }
};

}  // namespace deformlab
