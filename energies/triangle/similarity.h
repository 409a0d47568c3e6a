#pragma once

#include <array>

#include "energies/term.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Igarashi et al. 2005, Eq. 1–4, one triangle: the difference between each corner and where it
/// would be if the triangle were only moved, rotated and scaled so that the other two corners fit.
struct Similarity {
  static constexpr std::string_view kName = "similarity";
  static constexpr Structure kStructure = Structure::kLinear;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;

  /// (x, y) of each corner in the frame that the next two corners span [edge lengths].
  std::array<Eigen::Vector2d, 3> local;

  template <class T>
  Vector<T, 6> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>& v2) const {
    Vector<T, 6> r;
    r << desired(v1, v2, 0) - v0, desired(v2, v0, 1) - v1, desired(v0, v1, 2) - v2;
    return r;
  }

  /// Eq. 2: where corner c would be, given the two corners i and j that follow it. R90 is the same
  /// quarter turn here and in `over`; the printed matrix is its inverse.
  template <class T>
  Vector<T, 2> desired(const Vector<T, 2>& i, const Vector<T, 2>& j, int c) const {
    const Vector<T, 2> ij = j - i, R90_ij(-ij.y(), ij.x());
    return i + local[c].x() * ij + local[c].y() * R90_ij;
  }

  /// All triangles, with one weight for each (section 5.2). No edge may have length 0.
  static Terms<Similarity> over(const Triangulation& mesh, const Eigen::VectorXd& weights) {
    Terms<Similarity> sum;
    for (Eigen::Index f = 0; f < mesh.F.cols(); ++f) {
      Similarity triangle;
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector2d i = mesh.V.col(mesh.F((c + 1) % 3, f));
        const Eigen::Vector2d ij = mesh.V.col(mesh.F((c + 2) % 3, f)) - i, R90_ij(-ij.y(), ij.x());
        const Eigen::Vector2d v = mesh.V.col(mesh.F(c, f)) - i;
        triangle.local[c] = Eigen::Vector2d(v.dot(ij), v.dot(R90_ij)) / ij.squaredNorm();
      }
      sum.add(triangle, {mesh.F(0, f), mesh.F(1, f), mesh.F(2, f)}, weights[f]);
    }
    return sum;
  }
};

}  // namespace deformlab
