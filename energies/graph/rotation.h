#pragma once

#include "energies/graph/sums.h"

namespace deformlab {

/// E_rot, Sumner et al. 2007, Eq. 5 and 6, one node: R_j is a rotation if its columns are
/// orthonormal. The columns of a reflection are orthonormal too, so this term does not prevent it.
template <class Node = AffineNode<3>>
struct Rotation {
  static constexpr std::string_view kName = "rotation";
  static constexpr double kWeight = 1;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;
  static constexpr int d = Node::kDimension;

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

  static Terms<Rotation> over(const GraphContext& context) {
    Terms<Rotation> sum;
    for (int j = 0; j < context.graph.g.cols(); ++j) {
      sum.add(Rotation{}, {j}, context.stiffness_of(j));
    }
    return sum;
  }
};

}  // namespace deformlab
