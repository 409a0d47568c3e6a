#include "deformers/baselines/spokes_and_rims.h"

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Deformation_Eigen_polar_closest_rotation_traits_3.h>

#include <Eigen/Geometry>
#include <cmath>

namespace deformlab {
namespace {

// The sides of a triangle as columns, and the cotangents of the angles opposite to them.
struct Sides {
  Eigen::Matrix3d p;
  Eigen::Vector3d cot;
};

Eigen::Matrix3d sides(const Eigen::Matrix3Xd& V, const Eigen::Vector3i& t) {
  Eigen::Matrix3d p;
  for (int k = 0; k < 3; ++k) p.col(k) = V.col(t[(k + 2) % 3]) - V.col(t[(k + 1) % 3]);
  return p;
}

Sides weighted_sides(const Eigen::Matrix3Xd& V, const Eigen::Vector3i& t) {
  Sides s{sides(V, t), Eigen::Vector3d::Zero()};
  const double twice_area = s.p.col(0).cross(s.p.col(1)).norm();
  if (twice_area == 0) return s;  // CGAL's weights are 0 here too
  for (int k = 0; k < 3; ++k) {
    s.cot[k] = -s.p.col((k + 1) % 3).dot(s.p.col((k + 2) % 3)) / twice_area;
  }
  return s;
}

}  // namespace

SpokesAndRims spokes_and_rims(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xd& W,
                              const Eigen::Matrix3Xi& T) {
  SpokesAndRims result;
  Eigen::Matrix3Xd S = Eigen::Matrix3Xd::Zero(3, 3 * V.cols());  // Σ cot α_e p_e q_eᵀ
  for (const Eigen::Vector3i t : T.colwise()) {
    const auto [p, cot] = weighted_sides(V, t);
    const Eigen::Matrix3d covariance = p * cot.asDiagonal() * sides(W, t).transpose();
    for (const int i : t) S.middleCols<3>(3 * i) += covariance;
  }
  result.R.resize(3, S.cols());
  CGAL::Deformation_Eigen_polar_closest_rotation_traits_3 closest;
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    Eigen::Matrix3d R;
    closest.compute_close_rotation(S.middleCols<3>(3 * i), R);
    result.R.middleCols<3>(3 * i) = R;
  }
  for (const Eigen::Vector3i t : T.colwise()) {
    const auto [p, cot] = weighted_sides(V, t);
    const Eigen::Matrix3d q = sides(W, t);
    for (const int i : t) {
      const Eigen::RowVector3d squared =
          (q - result.R.middleCols<3>(3 * i) * p).colwise().squaredNorm();
      result.energy += squared.dot(cot);
      result.scale += p.colwise().squaredNorm().dot(cot.cwiseAbs());
    }
  }
  return result;
}

}  // namespace deformlab
