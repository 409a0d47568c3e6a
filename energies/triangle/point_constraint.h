#pragma once

#include <vector>

#include "energies/term.h"
#include "geometry/plane/barycentric_point.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// A handle that need not be a vertex: the difference between the point with the barycentric
/// coordinates b in a triangle and its target q. Igarashi et al. 2005, section 3, mention such
/// handles without a formula.
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

  /// All points, each of which has three different vertices. Until their targets are set, they stay
  /// where they are at rest.
  static Terms<PointConstraint> over(const Triangulation& mesh,
                                     const std::vector<BarycentricPoint>& points) {
    Terms<PointConstraint> sum;
    for (int l = 0; l < std::ssize(points); ++l) {
      const auto& [vertices, b] = points[l];
      sum.add({b, l, points[l].at(mesh.V)}, {vertices[0], vertices[1], vertices[2]});
    }
    return sum;
  }
};

}  // namespace deformlab
