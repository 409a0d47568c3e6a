#include "deformers/baselines/prism_layer.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "deformers/baselines/sides.h"

namespace deformlab {
namespace {

// The least area of the two triangles at a joint [‖e_ij‖²], which limits weights of thin triangles.
constexpr double kLeastArea = 1e-6;

Eigen::VectorXd areas(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  Eigen::VectorXd A(T.cols());
  for (Eigen::Index t = 0; t < T.cols(); ++t) {
    const Eigen::Vector3d a = V.col(T(0, t)), b = V.col(T(1, t)), c = V.col(T(2, t));
    A[t] = (b - a).cross(c - a).norm() / 2;
  }
  return A;
}

// The Gauss points of an edge v that is extruded by ±up. They integrate polynomials of third degree
// in each direction exactly.
Eigen::Matrix<double, 3, 4> gauss_points(const Eigen::Matrix<double, 3, 2>& v,
                                         const Eigen::Matrix<double, 3, 2>& up) {
  constexpr double kAt = std::numbers::inv_sqrt3;
  Eigen::Matrix<double, 3, 4> p;
  int g = 0;
  for (const double s : {-kAt, kAt}) {
    const Eigen::Vector2d along((1 - s) / 2, (1 + s) / 2);
    for (const double t : {-kAt, kAt}) p.col(g++) = v * along + t * (up * along);
  }
  return p;
}

}  // namespace

PrismLayer make_prisms(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T, double height) {
  PrismLayer prisms;
  prisms.T = T;
  prisms.b.resize(3, T.cols());
  Shape surface{V, {}, {}};
  for (Eigen::Index t = 0; t < T.cols(); ++t) {
    prisms.b.col(t) = V(Eigen::all, T.col(t)).rowwise().mean();
    surface.faces.push_back({T(0, t), T(1, t), T(2, t)});
  }
  const Eigen::Matrix3Xd up = height / 2 * vertex_normals(surface);
  const Eigen::VectorXd A = areas(V, T);
  const std::vector<Side> sides = sorted_sides(T);
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (!sides[s].same_edge(sides[s - 1])) continue;
    const int a = sides[s].low, b = sides[s].high;
    const int i = sides[s - 1].triangle, j = sides[s].triangle;
    const double length2 = (V.col(a) - V.col(b)).squaredNorm();
    if (length2 == 0) continue;
    const double w = length2 / std::max(A[i] + A[j], kLeastArea * length2);
    const std::array<int, 2> ends{a, b};
    prisms.joints.push_back({i, j, w / 4, gauss_points(V(Eigen::all, ends), up(Eigen::all, ends))});
  }
  return prisms;
}

double mean_side(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  double sum = 0;
  for (const auto corners : T.colwise()) {
    for (int k = 0; k < 3; ++k) sum += (V.col(corners[k]) - V.col(corners[(k + 1) % 3])).norm();
  }
  return sum > 0 ? sum / static_cast<double>(T.size()) : 1;
}

RigidMotions RigidMotions::at_rest(const PrismLayer& prisms) {
  return {Eigen::Matrix3d::Identity().replicate(1, prisms.b.cols()), prisms.b};
}

void fit_rigidly(const Eigen::Matrix3d& rest, const Eigen::Matrix3d& corners, int i,
                 RigidMotions& motions) {
  const Eigen::Vector3d b = rest.rowwise().mean(), c = corners.rowwise().mean();
  const Eigen::Matrix3d covariance = (corners.colwise() - c) * (rest.colwise() - b).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV()).determinant() < 0 ? -1 : 1;
  const Eigen::Vector3d signs(1, 1, sign);
  motions.rotation(i) = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  motions.c.col(i) = c;
}

void move(const RigidMotions& from, const Eigen::MatrixXd& velocities, double scale,
          RigidMotions& to) {
  to.c = from.c + scale * velocities.bottomRows<3>();
  for (int i = 0; i < from.c.cols(); ++i) {
    const Eigen::Vector3d omega = scale * velocities.col(i).head<3>();
    const Eigen::AngleAxisd turn(std::atan(omega.norm()), omega.stableNormalized());
    const Eigen::Quaterniond q(Eigen::Matrix3d(turn * from.rotation(i)));
    to.rotation(i) = q.normalized().toRotationMatrix();  // without drift over many steps
  }
}

}  // namespace deformlab
