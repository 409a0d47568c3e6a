#pragma once

#include "energies/term.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 5, one node: R_j is a rotation where its columns are orthonormal. A
/// reflection is too, for all this term can see.
struct Rotation {
  static constexpr std::string_view kName = "rotation";
  static constexpr Structure kStructure = Structure::kNonlinear;
  static constexpr double kWeight = 1;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;

  template <class T>
  Vector6<T> operator()(const Matrix3<T>& R) const {
    const auto c1 = R.col(0), c2 = R.col(1), c3 = R.col(2);
    return {c1.dot(c2),        c1.dot(c3),        c2.dot(c3),
            c1.dot(c1) - T(1), c2.dot(c2) - T(1), c3.dot(c3) - T(1)};
  }

  /// ∂r/∂(c1, c2, c3), 6×9.
  Eigen::Matrix<double, 6, 9> jacobian(const Eigen::Matrix3d& R) const {
    const Eigen::RowVector3d c1 = R.col(0), c2 = R.col(1), c3 = R.col(2), o(0, 0, 0);
    Eigen::Matrix<double, 6, 9> J;
    J << c2, c1, o,  //
        c3, o, c1,   //
        o, c3, c2,   //
        2 * c1, o, o, o, 2 * c2, o, o, o, 2 * c3;
    return J;
  }

  /// Eq. 6: all nodes.
  static Terms<Rotation> over(const DeformationGraph& graph) {
    Terms<Rotation> sum;
    for (int j = 0; j < graph.g.cols(); ++j) sum.add({}, {j});
    return sum;
  }
};

}  // namespace deformlab
