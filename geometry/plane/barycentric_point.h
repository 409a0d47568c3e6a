#pragma once

#include <Eigen/Core>
#include <complex>

namespace deformlab {

/// A place in a triangulation: Σ_c b_c v_c over at most three of its vertices.
struct BarycentricPoint {
  Eigen::Vector3i vertices;
  Eigen::Vector3d b;  ///< barycentric coordinates, exactly 0 for a vertex that does not count

  /// Where vertices at z (x + iy) take it [length].
  std::complex<double> operator()(const Eigen::VectorXcd& z) const {
    return b[0] * z[vertices[0]] + b[1] * z[vertices[1]] + b[2] * z[vertices[2]];
  }
  /// Where vertices at V (2×#V) take it [length].
  template <class Positions>
  Eigen::Vector2d at(const Positions& V) const {
    return b[0] * V.col(vertices[0]) + b[1] * V.col(vertices[1]) + b[2] * V.col(vertices[2]);
  }
  static BarycentricPoint at_vertex(int v) { return {Eigen::Vector3i::Constant(v), {1, 0, 0}}; }
};

}  // namespace deformlab
