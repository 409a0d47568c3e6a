#include "geometry/transfer/transfer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

struct Embedded {
  Shape shape = bumpy_plane(15);
  Eigen::Matrix3Xd g = random_points(12, {1, 1, 0.1}, 1);
  Embedding e = embed(shape.V, g, 4);
};

Transformations random_transformations(int m) {
  return rest_transformations(m) + 0.3 * random_points(4 * m, {1, 1, 1}, 5);
}

// The rigid motion p → Q p + c, as each node sees it.
Transformations rigid(const Eigen::Matrix3d& Q, const Eigen::Vector3d& c,
                      const Eigen::Matrix3Xd& g) {
  Transformations X(3, 4 * g.cols());
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    X.middleCols<4>(4 * j) << Q, Q * g.col(j) + c - g.col(j);
  }
  return X;
}

TEST(TransferPositions, StayAtRest) {
  const Embedded s;
  const Eigen::Matrix3Xd V = transfer_positions(rest_transformations(12), s.g, s.e);
  EXPECT_LT((V - s.shape.V).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(TransferPositions, AreEquation2) {
  const Embedded s;
  const Transformations X = random_transformations(12);
  const Eigen::Matrix3Xd V = transfer_positions(X, s.g, s.e);
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    Eigen::Vector3d expected(0, 0, 0);
    for (int a = 0; a < 4; ++a) {
      const int j = s.e.nodes(a, i);
      const Eigen::Matrix3d R = X.middleCols<3>(4 * j);
      expected +=
          s.e.weights(a, i) * (R * (s.shape.V.col(i) - s.g.col(j)) + s.g.col(j) + X.col(4 * j + 3));
    }
    EXPECT_LT((V.col(i) - expected).norm(), 1e-14);
  }
}

TEST(Transfer, ReproducesARigidMotion) {
  const Embedded s;
  const Eigen::Matrix3d Q = Eigen::Quaterniond(0.3, -0.5, 0.2, 0.8).normalized().matrix();
  const Eigen::Vector3d c(3, -1, 2);
  const Transformations X = rigid(Q, c, s.g);
  const Eigen::Matrix3Xd V = transfer_positions(X, s.g, s.e);
  EXPECT_LT((V - ((Q * s.shape.V).colwise() + c)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((transfer_normals(X, s.shape.N, s.e) - Q * s.shape.N).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(TransferNormals, AreEquation3) {
  const Embedded s;
  const Transformations X = random_transformations(12);
  const Eigen::Matrix3Xd N = transfer_normals(X, s.shape.N, s.e);
  for (Eigen::Index i = 0; i < N.cols(); ++i) {
    Eigen::Vector3d expected(0, 0, 0);
    for (int a = 0; a < 4; ++a) {
      const Eigen::Matrix3d R = X.middleCols<3>(4 * s.e.nodes(a, i));
      expected += s.e.weights(a, i) * R.inverse().transpose() * s.shape.N.col(i);
    }
    EXPECT_LT((N.col(i) - expected.normalized()).norm(), 1e-12);
  }
}

TEST(TransferNormals, StandOnAStretchedPlane) {
  Embedded s;
  const Eigen::Matrix3d stretch = Eigen::Vector3d(3, 1, 0.5).asDiagonal();
  const Eigen::Vector3d along = Eigen::Vector3d(1, 0, 1), normal = Eigen::Vector3d(-1, 0, 1);
  s.shape.N.colwise() = normal.normalized();
  const Eigen::Matrix3Xd N = transfer_normals(rigid(stretch, {0, 0, 0}, s.g), s.shape.N, s.e);
  EXPECT_LT((N.transpose() * (stretch * along)).cwiseAbs().maxCoeff(), 1e-14);
}

// Vertices are blended four at once, nodes two at once: some are left over.
TEST(Transfer, IsTheSameForOneVertexAsAmongOthers) {
  for (const int k : {1, 2, 3, 4, 5, 8}) {
    const Embedded s;
    const Embedding all = embed(s.shape.V, s.g, k);
    const Transformations X = random_transformations(12);
    for (const int n : {1, 2, 3, 4, 5, 10, 11}) {
      Embedding some{all.v.leftCols(n), all.nodes.leftCols(n), all.weights.leftCols(n)};
      const Eigen::Matrix3Xd V = transfer_positions(X, s.g, some);
      const Eigen::Matrix3Xd N = transfer_normals(X, s.shape.N.leftCols(n), some);
      for (int i = 0; i < n; ++i) {
        const Embedding one = subset(all, std::vector{i});
        EXPECT_EQ(V.col(i), transfer_positions(X, s.g, one)) << k << " nodes, vertex " << i;
        EXPECT_EQ(N.col(i), transfer_normals(X, s.shape.N.col(i), one)) << k << " nodes";
      }
    }
  }
}

TEST(Transfer, IsItsEquationForAnyNumberOfNodes) {
  const Embedded s;
  const Transformations X = random_transformations(12);
  for (const int k : {1, 2, 3, 5, 8}) {
    const Embedding e = embed(s.shape.V, s.g, k);
    Eigen::Matrix3Xd V = Eigen::Matrix3Xd::Zero(3, e.v.cols()), N = V;
    for (Eigen::Index i = 0; i < V.cols(); ++i) {
      for (int a = 0; a < k; ++a) {
        const int j = e.nodes(a, i);
        const Eigen::Matrix3d R = X.middleCols<3>(4 * j);
        V.col(i) +=
            e.weights(a, i) * (R * (e.v.col(i) - s.g.col(j)) + s.g.col(j) + X.col(4 * j + 3));
        N.col(i) += e.weights(a, i) * R.inverse().transpose() * s.shape.N.col(i);
      }
    }
    EXPECT_LT((transfer_positions(X, s.g, e) - V).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((transfer_normals(X, s.shape.N, e) - N.colwise().normalized()).cwiseAbs().maxCoeff(),
              1e-12);
  }
}

TEST(TransferNormals, StayAsTheyWereWhereTheyVanish) {
  const Embedded s;
  const Transformations X = Transformations::Zero(3, 48);
  EXPECT_EQ(transfer_normals(X, s.shape.N, s.e), s.shape.N);
}

TEST(TransferNormals, StayUnitAndFiniteWhereATransformationIsSingular) {
  const Embedded s;
  Transformations X = rest_transformations(12);
  for (int j = 0; j < 12; j += 2) X.middleCols<3>(4 * j).setZero();  // all is lost
  for (int j = 1; j < 12; j += 4) X(2, 4 * j + 2) = 0;               // flattened along z
  const Eigen::Matrix3Xd N = transfer_normals(X, s.shape.N, s.e);
  EXPECT_TRUE(N.allFinite());
  EXPECT_LT((N.colwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace deformlab::test
