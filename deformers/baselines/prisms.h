#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// Where two prisms share a face at rest. The squared distance of what has become of it in each,
/// ∫ ‖f^{i→j}(u) − f^{j→i}(u)‖² du over [0, 1]², f bilinear, is the mean over the four Gauss
/// points.
struct Joint {
  int i, j;                       ///< prisms
  double weight;                  ///< w_ij / 4
  Eigen::Matrix<double, 3, 4> p;  ///< the Gauss points at rest [length]
};

/// A rigid prism for each triangle of a surface, its corners extruded along the vertices' normals
/// by half a height to either side (Botsch, Pauly, Gross and Kobbelt 2006).
struct PrismLayer {
  Eigen::Matrix3Xi T;         ///< 3×m vertices of each prism's triangle
  Eigen::Matrix3Xd b;         ///< 3×m centroids of the triangles at rest [length]
  std::vector<Joint> joints;  ///< with w_ij = ‖e_ij‖² / (A_i + A_j)
};

/// Where more than two triangles have an edge in common, each is joined to the next in their order.
///   V  3×#V vertices, T  3×m triangles of three different vertices each, height > 0 [length].
PrismLayer make_prisms(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T, double height);

/// Whether corners (3×3 in columns) lie on a line or in a point, as far as a double can tell: no
/// motion of theirs says how a prism on them turns.
bool is_thin(const Eigen::Matrix3d& corners);

/// Mean length of the triangles' sides [length]; 1 where all are points.
double mean_side(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T);

/// Rigid motions of prisms: x ↦ R_i (x − b_i) + c_i.
struct RigidMotions {
  Eigen::Matrix3Xd R;  ///< 3×3m rotations side by side
  Eigen::Matrix3Xd c;  ///< 3×m [length]

  static RigidMotions at_rest(const PrismLayer& prisms);
  auto rotation(int i) const { return R.middleCols<3>(3 * i); }
  auto rotation(int i) { return R.middleCols<3>(3 * i); }
  Eigen::Vector3d apply(const PrismLayer& prisms, int i, const Eigen::Vector3d& x) const {
    return rotation(i) * (x - prisms.b.col(i)) + c.col(i);
  }
};

/// The motion of one prism that takes its triangle closest to `corners` (3×3 vertices in columns),
/// in the sense of least squares.
void fit_rigidly(const Eigen::Matrix3d& rest, const Eigen::Matrix3d& corners, int i,
                 RigidMotions& motions);

/// From one state along velocities (6×m: ω_i, v_i), `scale` of the way. The linear motion x + ω×(x
/// − c) + v is projected to the closest rigid one, a rotation about ω by atan ‖ω‖.
void move(const RigidMotions& from, const Eigen::MatrixXd& velocities, double scale,
          RigidMotions& to);

}  // namespace deformlab
