#pragma once

#include "energies/term.h"

namespace deformlab {

/// Sumner et al. 2007, Eq. 5, one node: R_j is a rotation where its columns are orthonormal. A
/// reflection is too, for all this term can see.
template <int d = 3>
struct Rotation {
  static constexpr std::string_view kName = "rotation";
  static constexpr Structure kStructure = Structure::kNonlinear;
  static constexpr double kWeight = 1;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;

  /// c_a · c_b for all a < b, then c_a · c_a − 1.
  template <class T>
  Vector<T, d*(d + 1) / 2> operator()(const Matrix<T, d>& R) const {
    Vector<T, d*(d + 1) / 2> r;
    int i = 0;
    for (int a = 0; a < d; ++a) {
      for (int b = a + 1; b < d; ++b) r[i++] = R.col(a).dot(R.col(b));
    }
    for (int a = 0; a < d; ++a) r[i++] = R.col(a).dot(R.col(a)) - T(1);
    return r;
  }

  /// ∂r/∂(c_1, …, c_d).
  Eigen::Matrix<double, d*(d + 1) / 2, d * d> jacobian(const Matrix<double, d>& R) const {
    Eigen::Matrix<double, d*(d + 1) / 2, d * d> J;
    J.setZero();
    int i = 0;
    for (int a = 0; a < d; ++a) {
      for (int b = a + 1; b < d; ++b, ++i) {
        J.row(i).template segment<d>(d * a) = R.col(b);
        J.row(i).template segment<d>(d * b) = R.col(a);
      }
    }
    for (int a = 0; a < d; ++a) J.row(i++).template segment<d>(d * a) = 2 * R.col(a);
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
