#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

/// A face that two prisms share at rest. The joint's energy is the squared distance of the images
/// of this face under the motions of the two prisms, ∫ ‖f^{i→j}(u) − f^{j→i}(u)‖² du over [0, 1]²
/// with bilinear f. It is the mean over the four Gauss points.
struct Joint {
  int i, j;                       ///< prisms
  double weight;                  ///< w_ij / 4
  Eigen::Matrix<double, 3, 4> p;  ///< the Gauss points at rest [length]
};

/// One rigid prism for each triangle of a surface. It is the triangle extruded along the normals of
/// its vertices by half of the height to either side (Botsch, Pauly, Gross and Kobbelt 2006).
struct PrismLayer {
  Eigen::Matrix3Xi T;         ///< 3×m vertices of each prism's triangle
  Eigen::Matrix3Xd b;         ///< 3×m centroids of the triangles at rest [length]
  std::vector<Joint> joints;  ///< with w_ij = ‖e_ij‖² / (A_i + A_j)
};

/// Where more than two triangles share an edge, each is joined to the next one in their order.
///   V       3×#V vertices [length]
///   T       3×m triangles, three different vertices each
///   height  of the prisms, positive [length]
PrismLayer make_prisms(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T, double height);

/// The mean length of the triangles' sides [length], or 1 where all triangles are points.
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

/// Sets the motion of prism i to the one that takes its triangle `rest` closest to `corners` in the
/// least-squares sense (both 3×3, vertices in columns).
void fit_rigidly(const Eigen::Matrix3d& rest, const Eigen::Matrix3d& corners, int i,
                 RigidMotions& motions);

/// Sets `to` to the motions `from` after a step of `scale` times the velocities (6×m: ω_i, v_i).
/// The linear motion x + ω×(x − c) + v is projected to the closest rigid one, which is a rotation
/// about ω by atan ‖ω‖ and the translation v.
void move(const RigidMotions& from, const Eigen::MatrixXd& velocities, double scale,
          RigidMotions& to);

}  // namespace deformlab
