#pragma once

#include <Eigen/Geometry>

#include "energies/graph/rotation_vector.h"

namespace deformlab {

/// The transformation of a graph node as a matrix R_j and a translation t_j (Sumner et al. 2007,
/// Eq. 1), in space (d = 3) or in the plane (d = 2).
template <class T, int d>
struct Affine {
  Matrix<T, d> R;
  Vector<T, d> t;  ///< [length]

  /// R_j v, as an Eigen expression that is only valid as long as v is.
  auto rotated(const auto& v) const { return R * v; }
  /// R_j e_c.
  auto axis(int c) const { return R.col(c); }
};

/// The transformation of a node that can only rotate and move: the rotation vector ω_j, whose
/// length is the angle, and t_j.
template <class T>
struct Rigid {
  Vector<T, 3> omega;
  Vector<T, 3> t;  ///< [length]

  /// R_j v, where R_j = exp(ω_j).
  Vector<T, 3> rotated(const Eigen::Vector3d& v) const { return deformlab::rotated<T>(omega, v); }
  /// R_j e_c.
  Vector<T, 3> axis(int c) const { return rotated(Eigen::Vector3d::Unit(c)); }
};

template <class T, int d>
struct Reads<Affine<T, d>> {
  static constexpr int kDimension = d, kColumns = d + 1;
  static Affine<T, d> from(const double* x, bool active) {
    return {Reads<Matrix<T, d>>::from(x, active), Reads<Vector<T, d>>::from(x, active, d * d)};
  }
};

template <class T>
struct Reads<Rigid<T>> {
  static constexpr int kDimension = 3, kColumns = 2;
  static Rigid<T> from(const double* x, bool active) {
    return {Reads<Vector<T, 3>>::from(x, active), Reads<Vector<T, 3>>::from(x, active, 3)};
  }
};

/// A node model says what the unknowns of a graph node are. The terms over a graph are templates on
/// it. `kLinear` says whether R_j v is linear in the unknowns.
template <int d>
struct AffineNode {
  static constexpr int kDimension = d, kColumns = d + 1;
  static constexpr bool kLinear = true;
  template <class T>
  using State = Affine<T, d>;
  /// R_j = I and t_j = 0, d × kColumns.
  static Eigen::MatrixXd rest() { return Eigen::MatrixXd::Identity(d, d + 1); }
};

struct RigidNode {
  static constexpr int kDimension = 3, kColumns = 2;
  static constexpr bool kLinear = false;
  template <class T>
  using State = Rigid<T>;
  /// ω_j = 0 and t_j = 0, 3 × kColumns.
  static Eigen::MatrixXd rest() { return Eigen::MatrixXd::Zero(3, 2); }
};

/// What a term reads of one node, for the scalar T: Affine<T, d> or Rigid<T>. Both have `t`,
/// `rotated(v)` and `axis(c)`, so that one definition of a term serves every model.
template <class Node, class T>
using State = typename Node::template State<T>;

}  // namespace deformlab
