#pragma once

#include <Eigen/LU>
#include <cmath>

#include "energies/term.h"
#include "geometry/plane/triangulation.h"

// The map from a triangle of the plane at rest to the deformed one, which terms over triangles
// measure.
namespace deformlab {

/// A triangle at rest. What it computes is for the corners v0, v1, v2 of the deformed one.
struct RestTriangle {
  Eigen::Matrix2d inverse;  ///< of the edges v1 − v0 and v2 − v0 at rest, as columns [1/length]

  /// J, the linear part of the map.
  template <class T>
  Matrix<T, 2> gradient(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                        const Vector<T, 2>& v2) const {
    Matrix<T, 2> edges;
    edges.col(0) = v1 - v0;
    edges.col(1) = v2 - v0;
    return edges * inverse.cast<T>();
  }
};

/// The rotation that is nearest to J. Where all rotations are as near, which only mirror images of
/// similarities are, it is the zero matrix, so that derivatives exist.
template <class T>
Matrix<T, 2> nearest_rotation(const Matrix<T, 2>& J) {
  using std::sqrt;
  constexpr double kTiny = 1e-16;  // squared, of a size that is 2 at rest
  const T a = J(0, 0) + J(1, 1), b = J(1, 0) - J(0, 1);
  const T size = sqrt(a * a + b * b + T(kTiny));
  Matrix<T, 2> R;
  R << a / size, -b / size, b / size, a / size;
  return R;
}

/// Σ over all triangles, each weighted by its area at rest and by its stiffness.
///   weights  #F
template <class Term>
Terms<Term> over_triangles(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  Terms<Term> sum;
  for (Eigen::Index f = 0; f < mesh.F.cols(); ++f) {
    const Eigen::Vector3i t = mesh.F.col(f);
    Eigen::Matrix2d edges;
    edges << mesh.V.col(t[1]) - mesh.V.col(t[0]), mesh.V.col(t[2]) - mesh.V.col(t[0]);
    const double area = std::abs(edges.determinant()) / 2;
    sum.add({{edges.inverse()}}, {t[0], t[1], t[2]}, area * weights[f]);
  }
  return sum;
}

}  // namespace deformlab
