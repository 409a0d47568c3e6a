#include "geometry/transfer/embedding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/core/error.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

// Nodes at x = 0, 1, 3 and 6.
Eigen::Matrix3Xd four_nodes() {
  Eigen::Matrix3Xd g = Eigen::Matrix3Xd::Zero(3, 4);
  g.row(0) << 0, 1, 3, 6;
  return g;
}

TEST(Embed, IsEquation4ByHand) {
  // The vertex at x = 1.2 is 1.2, 0.2, 1.8 from the first three nodes; with k = 2, d_max = 1.8.
  const Embedding e = embed(Eigen::Vector3d(1.2, 0, 0), four_nodes(), 2);
  ASSERT_EQ(e.nodes.rows(), 2);
  EXPECT_EQ(e.nodes(0, 0), 1);
  EXPECT_EQ(e.nodes(1, 0), 0);
  const double w1 = std::pow(1 - 0.2 / 1.8, 2), w0 = std::pow(1 - 1.2 / 1.8, 2);
  EXPECT_NEAR(e.weights(0, 0), w1 / (w1 + w0), 1e-15);
  EXPECT_NEAR(e.weights(1, 0), w0 / (w1 + w0), 1e-15);
}

TEST(Embed, GivesWeightsThatPartitionUnity) {
  const Shape plane = bumpy_plane(30);
  for (const int k : {1, 4, 8, kMaxNeighbors}) {
    const Embedding e = embed(plane.V, random_points(40, {1, 1, 0.1}, 3), k);
    EXPECT_EQ(e.v, plane.V);
    EXPECT_EQ(e.nodes.rows(), k);
    EXPECT_GE(e.weights.minCoeff(), 0);
    EXPECT_LT((e.weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  }
}

TEST(Embed, FindsTheNearestNodesNearestFirst) {
  const Eigen::Matrix3Xd v = random_points(200, {1, 1, 1}, 1), g = random_points(50, {1, 1, 1}, 2);
  const Embedding e = embed(v, g, 4);
  for (Eigen::Index i = 0; i < v.cols(); ++i) {
    const Eigen::RowVectorXd distance = (g.colwise() - v.col(i)).colwise().norm();
    std::vector<int> order(g.cols());
    for (int j = 0; j < g.cols(); ++j) order[j] = j;
    std::sort(order.begin(), order.end(), [&](int a, int b) { return distance[a] < distance[b]; });
    for (int a = 0; a < 4; ++a) EXPECT_EQ(e.nodes(a, i), order[a]);
    EXPECT_GE(e.weights(0, i), e.weights(3, i));
  }
}

// The nodes of one point are sought near those of the point before.
TEST(Embed, FindsTheSameForOnePointAsAmongOthers) {
  const Shape plane = bumpy_plane(30);
  Eigen::Matrix3Xd apart = plane.V;  // far from the point before, at it, and at nodes
  for (Eigen::Index i = 0; i < apart.cols(); i += 3) apart.col(i) = 1e6 * plane.V.col(i);
  apart.col(7) = apart.col(8);
  const Eigen::Matrix3Xd random = random_points(60, {1, 1, 0.1}, 3);
  const Eigen::Matrix3Xd regular = bumpy_plane(8).V;  // nodes that are equally far
  apart.col(10) = random.col(5);
  for (const Eigen::Matrix3Xd& v : {plane.V, apart}) {
    for (const Eigen::Matrix3Xd& g : {random, regular}) {
      for (const int k : {1, 4, 8, kMaxNeighbors}) {
        const Embedding e = embed(v, g, k);
        for (Eigen::Index i = 0; i < v.cols(); ++i) {
          const Embedding one = embed(v.col(i), g, k);
          ASSERT_EQ(e.nodes.col(i), one.nodes) << "point " << i << ", " << k << " neighbors";
          ASSERT_EQ(e.weights.col(i), one.weights) << "point " << i << ", " << k << " neighbors";
        }
      }
    }
  }
}

TEST(Embed, SharesEquallyAmongEquidistantNodes) {
  Eigen::Matrix3Xd g(3, 4);  // a regular tetrahedron about the origin
  g << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  const Embedding e = embed(Eigen::Vector3d::Zero(), g, 3);
  EXPECT_EQ(e.weights, Eigen::Vector3d::Constant(1.0 / 3));
}

TEST(Embed, SharesEquallyWhereAllNodesLieOnTheVertex) {
  const Embedding e = embed(Eigen::Vector3d::Ones(), Eigen::Matrix3Xd::Ones(3, 5), 4);
  EXPECT_EQ(e.weights, Eigen::Vector4d::Constant(0.25));
}

TEST(Embed, TakesFewerNeighborsWhereThereAreTooFewNodes) {
  const Eigen::Matrix3Xd v = random_points(10, {6, 1, 1}, 1), g = four_nodes();
  for (const auto& [m, k] : {std::pair{4, 3}, {3, 2}, {2, 1}, {1, 1}}) {
    const Embedding e = embed(v, g.leftCols(m), 4);
    EXPECT_EQ(e.nodes.rows(), k) << m << " nodes";
    EXPECT_LT((e.weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  }
  EXPECT_EQ(embed(v, g.leftCols(1), 4).weights, Eigen::RowVectorXd::Ones(10));
}

TEST(Embed, RejectsNoNodesAndNeighborsOutOfRange) {
  const Eigen::Vector3d v(0, 0, 0);
  EXPECT_THROW(embed(v, Eigen::Matrix3Xd(3, 0), 4), InputError);
  for (const int k : {-1, 0, kMaxNeighbors + 1})
    EXPECT_THROW(embed(v, four_nodes(), k), InputError);
}

TEST(Subset, KeepsTheOrderThatIsAskedFor) {
  const Embedding e = embed(random_points(20, {6, 1, 1}, 1), four_nodes(), 2);
  const Embedding s = subset(e, std::vector<int>{7, 3, 7});
  ASSERT_EQ(s.v.cols(), 3);
  EXPECT_EQ(s.v.col(0), e.v.col(7));
  EXPECT_EQ(s.nodes.col(1), e.nodes.col(3));
  EXPECT_EQ(s.weights.col(2), e.weights.col(7));
}

}  // namespace
}  // namespace deformlab::test
