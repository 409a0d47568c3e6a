#pragma once

#include <Eigen/LU>

#include "energies/graph/sums.h"

namespace deformlab {

/// Prevents nodes from turning space inside out: det R_j should not be less than a small positive
/// number. The term is zero if this holds. Sumner et al. 2007 have no such term, and their E_rot
/// (Eq. 5) is as small for a reflection as for a rotation.
template <class Node = AffineNode<3>>
struct Orientation {
  static constexpr std::string_view kName = "orientation";
  static constexpr bool kZeroAtRest = true;
  static constexpr bool kRigidlyInvariant = true;

  struct Options {
    /// Large enough that a moderate weight keeps det R_j positive, but less than the values that
    /// compression alone leads to.
    double least = 0.1;

    template <class Self, class Visit>
    static void fields(Self& o, Visit&& visit) {
      visit("least", o.least, "The value of det R_j below which the term counts; it is 1 at rest");
    }
  };

  double least;

  template <class T>
  Vector<T, 1> operator()(const Matrix<T, Node::kDimension>& R) const {
    const T below = T(least) - R.determinant();
    return Vector<T, 1>(below > T(0) ? below : T(0));
  }

  static Terms<Orientation> over(const GraphContext& context, const Options& options) {
    return over_nodes<Orientation>(context, [&](int) { return Orientation{options.least}; });
  }
};

}  // namespace deformlab
