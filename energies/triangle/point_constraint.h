#pragma once

#include <vector>

#include "energies/term.h"
#include "geometry/plane/barycentric_point.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// A handle that need be no vertex (Igarashi et al. 2005, section 3, leaves it open): the place
/// with barycentric coordinates b in a triangle comes to its target q.
struct PointConstraint {
  static constexpr std::string_view kName = "point_constraint";
  static constexpr Structure kStructure = Structure::kKronecker;
  static constexpr bool kZeroAtRest = true;

  Eigen::Vector3d b;
  int l;              ///< column of the targets
  Eigen::Vector2d q;  ///< [length]

  template <class T>
  Vector<T, 2> operator()(const Vector<T, 2>& v0, const Vector<T, 2>& v1,
                          const Vector<T, 2>& v2) const {
    return b[0] * v0 + b[1] * v1 + b[2] * v2 - q;
  }

  void set_targets(const Eigen::MatrixXd& targets) { q = targets.col(l); }

  /// Every place, held where it is at rest until it is aimed at a target. Each has three different
  /// vertices.
  static Terms<PointConstraint> over(const Triangulation& mesh,
                                     const std::vector<BarycentricPoint>& places) {
    Terms<PointConstraint> sum;
    for (int l = 0; l < std::ssize(places); ++l) {
      const auto& [vertices, b] = places[l];
      sum.add({b, l, places[l].at(mesh.V)}, {vertices[0], vertices[1], vertices[2]});
    }
    return sum;
  }
};

}  // namespace deformlab
