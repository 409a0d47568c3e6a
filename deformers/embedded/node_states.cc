#include "deformers/embedded/node_states.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

#include "energies/graph/nodes.h"

namespace deformlab {

Unknowns rest_states(NodeModel model, int d, int m) {
  const Eigen::MatrixXd node = model == NodeModel::kRigid ? RigidNode::rest()
                               : d == 2                   ? AffineNode<2>::rest()
                                                          : AffineNode<3>::rest();
  return Unknowns::uniform(node.replicate(1, m), m);
}

Transformations to_transformations(const Unknowns& x, NodeModel model, double unit) {
  const int d = x.dimension();
  Transformations X = rest_transformations(x.nodes());
  for (int j = 0; j < x.nodes(); ++j) {
    const auto node = x.X.middleCols(x.first[j], x.columns(j));
    if (model == NodeModel::kRigid) {
      const Rigid<double> rigid = Reads<Rigid<double>>::from(x.node(j), false);
      for (int a = 0; a < 3; ++a) X.col(4 * j + a) = rigid.axis(a);
    } else {
      X.block(0, 4 * j, d, d) = node.leftCols(d);
    }
    X.block(0, 4 * j + 3, d, 1) = unit * node.rightCols<1>();
  }
  return X;
}

void set_transformations(const Transformations& X, NodeModel model, double unit,
                         const std::vector<char>& fixed, Unknowns& x) {
  const int d = x.dimension();
  for (int j = 0; j < x.nodes(); ++j) {
    if (fixed[j]) continue;
    auto node = x.X.middleCols(x.first[j], x.columns(j));
    node.rightCols<1>() = X.col(4 * j + 3).head(d) / unit;
    if (model == NodeModel::kRigid) {
      const Eigen::AngleAxisd turn(nearest_rotation(X.middleCols<3>(4 * j)));
      node.col(0) = turn.angle() * turn.axis();
    } else {
      node.leftCols(d) = X.block(0, 4 * j, d, d);
    }
  }
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

Determinants determinants(const Transformations& X) {
  Determinants result;
  for (Eigen::Index j = 0; j < X.cols() / 4; ++j) {
    const double det = X.middleCols<3>(4 * j).determinant();
    result.least = std::min(result.least, det);
    result.inside_out += det < 0;
  }
  return result;
}

}  // namespace deformlab
