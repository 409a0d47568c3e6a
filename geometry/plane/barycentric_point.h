#pragma once

#include <Eigen/Core>
#include <complex>

namespace deformlab {

/// A point of a triangulation: Σ_c b_c v_c over at most three of its vertices v_c.
struct BarycentricPoint {
  Eigen::Vector3i vertices;
  Eigen::Vector3d b;  ///< barycentric coordinates, exactly 0 for a vertex without influence

  /// Its position when the vertices are at z (#V numbers x + iy) [length].
  std::complex<double> operator()(const Eigen::VectorXcd& z) const {
    return b[0] * z[vertices[0]] + b[1] * z[vertices[1]] + b[2] * z[vertices[2]];
  }
  /// Its position when the vertices are at V (2×#V) [length].
  template <class Positions>
  Eigen::Vector2d at(const Positions& V) const {
    return b[0] * V.col(vertices[0]) + b[1] * V.col(vertices[1]) + b[2] * V.col(vertices[2]);
  }
  static BarycentricPoint at_vertex(int v) { return {Eigen::Vector3i::Constant(v), {1, 0, 0}}; }
};

}  // namespace deformlab
