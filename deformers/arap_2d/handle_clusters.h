#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/plane/barycentric_point.h"

namespace deformlab {

/// Handles that share vertices, and therefore depend on each other. Their barycentric coordinates
/// over the vertices of all of them are the rows of C = U Σ Vᵀ.
struct HandleCluster {
  std::vector<int> points;    ///< the handles, as indices of the barycentric points
  std::vector<int> vertices;  ///< the columns of C, as indices of vertices
  /// V, #vertices × #vertices. Handles prescribe the combinations of vertices in the first rank()
  /// columns, and those in the other columns are free.
  Eigen::MatrixXd V;
  /// Σ⁺Uᵀ, rank() × #points, maps the targets of the handles to the prescribed combinations. More
  /// handles than combinations meet their targets in the least-squares sense.
  Eigen::MatrixXd from_targets;

  Eigen::Index rank() const { return from_targets.rows(); }
};

/// The clusters of handles at these points of a mesh. Handles nearer to each other than 1e-6 of a
/// triangle count as one.
std::vector<HandleCluster> cluster_handles(const std::vector<BarycentricPoint>& points);

}  // namespace deformlab
