#pragma once

#include <Eigen/LU>

#include "energies/term.h"

namespace deformlab {

/// A node does not turn space inside out: det R_j is not below a small positive number. One-sided,
/// and nothing where that holds. Sumner et al. 2007 have no such term: E_rot (Eq. 5) is as small
/// for a reflection as for a rotation.
template <int d = 3>
struct Orientation {
  static constexpr std::string_view kName = "orientation";
  static constexpr Structure kStructure = Structure::kNonlinear;
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;
  /// Far enough above 0 that a weight that is not huge keeps det R_j positive, and below what mere
  /// compression comes to.
  static constexpr double kLeast = 0.1;

  template <class T>
  Eigen::Matrix<T, 1, 1> operator()(const Matrix<T, d>& R) const {
    const T below = T(kLeast) - R.determinant();
    return Eigen::Matrix<T, 1, 1>(below > T(0) ? below : T(0));
  }

  /// All nodes.
  static Terms<Orientation> over(const DeformationGraph& graph) {
    Terms<Orientation> sum;
    for (int j = 0; j < graph.g.cols(); ++j) sum.add({}, {j});
    return sum;
  }
};

}  // namespace deformlab
