#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/plane/barycentric_point.h"

namespace deformlab {

/// Places that share vertices, and so have to be seen together. Their barycentric coordinates are
/// the rows of C, over the vertices of all of them; C = U Σ Vᵀ.
struct Cluster {
  std::vector<int> places;
  std::vector<int> vertices;
  /// #vertices × #vertices, orthogonal: the first rank() columns are the combinations of vertices
  /// that are held, the others those that stay free.
  Eigen::MatrixXd V;
  /// rank() × #places, Σ⁺Uᵀ: from the places' targets to the held combinations that meet them, in
  /// the least-squares sense where there are more places than combinations.
  Eigen::MatrixXd pull;

  Eigen::Index rank() const { return pull.rows(); }
};

/// The clusters of places in a mesh of so many vertices. Places nearer to each other than 1e-6 of a
/// triangle count as one.
std::vector<Cluster> clusters(const std::vector<BarycentricPoint>& places, Eigen::Index vertices);

}  // namespace deformlab
