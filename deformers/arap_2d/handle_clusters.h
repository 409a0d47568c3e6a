#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/plane/barycentric_point.h"

namespace deformlab {

/// Handles that share vertices, and so have to be considered together. Their barycentric
/// coordinates over the vertices of all of them are the rows of C = U Σ Vᵀ.
struct HandleCluster {
  std::vector<int> points;    ///< the handles, as indices of the barycentric points
  std::vector<int> vertices;  ///< the columns of C, as indices of vertices
  /// V, #vertices × #vertices: the first rank() columns are the combinations of vertices that the
  /// handles prescribe, the others those that stay free.
  Eigen::MatrixXd V;
  /// Σ⁺Uᵀ, rank() × #points: from the targets of the handles to the prescribed combinations that
  /// meet them. Where there are more handles than combinations, they meet them in the
  /// least-squares sense.
  Eigen::MatrixXd from_targets;

  Eigen::Index rank() const { return from_targets.rows(); }
};

/// The clusters of handles at these points of a mesh with `vertices` vertices. Handles nearer to
/// each other than 1e-6 of a triangle count as one.
std::vector<HandleCluster> cluster_handles(const std::vector<BarycentricPoint>& points,
                                           Eigen::Index vertices);

}  // namespace deformlab
