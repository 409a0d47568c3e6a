#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace deformlab {

/// A place of a triangulation that is held: Σ_c b_c v_c over at most three of its vertices.
struct Place {
  Eigen::Vector3i vertices;
  Eigen::Vector3d b;  ///< barycentric coordinates, exactly 0 for a vertex that does not count

  /// Where vertices at z (x + iy) take it [length].
  std::complex<double> operator()(const Eigen::VectorXcd& z) const {
    return b[0] * z[vertices[0]] + b[1] * z[vertices[1]] + b[2] * z[vertices[2]];
  }
  static Place at_vertex(int v) { return {Eigen::Vector3i::Constant(v), {1, 0, 0}}; }
};

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
std::vector<Cluster> clusters(const std::vector<Place>& places, Eigen::Index vertices);

}  // namespace deformlab
