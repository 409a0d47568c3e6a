#include "geometry/transfer.h"

#include <Eigen/Geometry>
#include <cmath>

namespace deformlab {
namespace {

// det(R) R^{-T}: its columns are the cross products of R's.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& R) {
  Eigen::Matrix3d C;
  C << R.col(1).cross(R.col(2)), R.col(2).cross(R.col(0)), R.col(0).cross(R.col(1));
  return C;
}

// R^{-T} for each node, 3×3m.
Eigen::Matrix3Xd inverse_transposes(const Transformations& X) {
  const Eigen::Index m = X.cols() / 4;
  Eigen::Matrix3Xd result(3, 3 * m);
  for (Eigen::Index j = 0; j < m; ++j) {
    const Eigen::Matrix3d R = X.middleCols<3>(4 * j);
    const double det = R.determinant();
    result.middleCols<3>(3 * j) = cofactors(R) / (std::abs(det) > 1e-12 ? det : 1.0);
  }
  return result;
}

}  // namespace

Transformations rest_transformations(Eigen::Index m) {
  return Eigen::Matrix<double, 3, 4>::Identity().replicate(1, m);
}

Eigen::Matrix3Xd transfer_positions(const Transformations& X, const Eigen::Matrix3Xd& g,
                                    const Embedding& e) {
  // R_j (v − g_j) + g_j + t_j = R_j v + s_j: one offset a node instead of a subtraction a vertex.
  const Eigen::Index m = g.cols();
  Eigen::Matrix3Xd s(3, m);
  for (Eigen::Index j = 0; j < m; ++j) {
    s.col(j) = g.col(j) + X.col(4 * j + 3) - X.middleCols<3>(4 * j) * g.col(j);
  }
  const Eigen::Index k = e.nodes.rows();
  Eigen::Matrix3Xd result(3, e.v.cols());
  for (Eigen::Index i = 0; i < e.v.cols(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index a = 0; a < k; ++a) {
      const int j = e.nodes(a, i);
      sum += e.weights(a, i) * (X.middleCols<3>(4 * j) * e.v.col(i) + s.col(j));
    }
    result.col(i) = sum;
  }
  return result;
}

Eigen::Matrix3Xd transfer_normals(const Transformations& X, const Eigen::Matrix3Xd& N,
                                  const Embedding& e) {
  const Eigen::Matrix3Xd C = inverse_transposes(X);
  Eigen::Matrix3Xd result(3, N.cols());
  for (Eigen::Index i = 0; i < N.cols(); ++i) {
    Eigen::Matrix3d blend = Eigen::Matrix3d::Zero();
    for (Eigen::Index a = 0; a < e.nodes.rows(); ++a) {
      blend += e.weights(a, i) * C.middleCols<3>(3 * e.nodes(a, i));
    }
    const Eigen::Vector3d n = blend * N.col(i);
    const double length = n.norm();
    result.col(i) = length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d(N.col(i));
  }
  return result;
}

}  // namespace deformlab
