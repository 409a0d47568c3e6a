#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "geometry/core/error.h"
#include "geometry/graph/deformation_graph.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::ElementsAre;

// Five nodes and three vertices, which follow (0, 1), (1, 0) and (2, 4).
Embedding by_hand() {
  Embedding e{Eigen::Matrix3Xd::Zero(3, 3), Eigen::MatrixXi(2, 3), Eigen::MatrixXd(2, 3)};
  e.nodes << 0, 1, 2, 1, 0, 4;
  e.weights << 0.5, 0.75, 1, 0.5, 0.25, 0;
  return e;
}

Eigen::Matrix3Xd places() {
  Eigen::Matrix3Xd g = Eigen::Matrix3Xd::Zero(3, 5);
  g.row(0) << 0, 1, 5, 6, 8;
  return g;
}

TEST(Connect, JoinsWhatSharesAVertexOnce) {
  const DeformationGraph graph = connect(places(), by_hand());
  ASSERT_EQ(graph.edges.size(), 2u);
  EXPECT_EQ(graph.edges[0].j, 0);
  EXPECT_EQ(graph.edges[0].k, 1);
  EXPECT_EQ(graph.edges[1].j, 2);
  EXPECT_EQ(graph.edges[1].k, 4);
  for (const GraphEdge& edge : graph.edges) EXPECT_EQ(edge.alpha, 1);
  EXPECT_EQ(graph.g, places());
}

TEST(Connect, WeighsByOverlap) {
  // Σ w_j w_k is 0.5 · 0.5 + 0.75 · 0.25 for the first edge, 0 for the second; the mean becomes 1.
  const DeformationGraph graph = connect(places(), by_hand(), EdgeWeights::kOverlap);
  EXPECT_DOUBLE_EQ(graph.edges[0].alpha, 2);
  EXPECT_EQ(graph.edges[1].alpha, 0);
}

TEST(Connect, WeighsByLength) {
  // Lengths 1 and 3: 1 and 1/9, whose mean becomes 1.
  const DeformationGraph graph = connect(places(), by_hand(), EdgeWeights::kLength);
  EXPECT_DOUBLE_EQ(graph.edges[0].alpha, 1.8);
  EXPECT_DOUBLE_EQ(graph.edges[1].alpha, 0.2);
  for (const double scale : {1e-50, 1e50}) {
    EXPECT_DOUBLE_EQ(connect(scale * places(), by_hand(), EdgeWeights::kLength).edges[1].alpha, 0.2)
        << scale;
  }
}

TEST(Connect, WeighsEdgesOfNoLengthLikeTheShortest) {
  DeformationGraph graph{places(), {{0, 1, 1}, {0, 2, 1}, {1, 2, 1}}};
  graph.g.col(1) = graph.g.col(0);
  weigh_by_length(graph);
  for (const GraphEdge& edge : graph.edges) EXPECT_DOUBLE_EQ(edge.alpha, 1);
  graph.g.colwise() = Eigen::Vector3d(1, 2, 3);
  weigh_by_length(graph);
  for (const GraphEdge& edge : graph.edges) EXPECT_DOUBLE_EQ(edge.alpha, 1);
}

TEST(Connect, GivesExactlyTheEdgesOfTheDefinition) {
  const Eigen::Matrix3Xd g = random_points(40, {1, 1, 0.1}, 3);
  const Embedding e = embed(bumpy_plane(30).V, g, 4);
  std::set<std::pair<int, int>> expected;
  for (Eigen::Index i = 0; i < e.nodes.cols(); ++i) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        if (e.nodes(a, i) < e.nodes(b, i)) expected.insert({e.nodes(a, i), e.nodes(b, i)});
      }
    }
  }
  for (const EdgeWeights alpha :
       {EdgeWeights::kUniform, EdgeWeights::kOverlap, EdgeWeights::kLength}) {
    const DeformationGraph graph = connect(g, e, alpha);
    std::vector<std::pair<int, int>> found;
    double sum = 0;
    for (const GraphEdge& edge : graph.edges) {
      found.emplace_back(edge.j, edge.k);
      sum += edge.alpha;
      EXPECT_GE(edge.alpha, 0);
    }
    EXPECT_EQ(found, std::vector(expected.begin(), expected.end()));
    EXPECT_NEAR(sum / std::ssize(graph.edges), 1, 1e-13) << alpha;
  }
}

TEST(Components, AreNumberedInTheOrderOfTheirFirstNodes) {
  EXPECT_THAT(components(connect(places(), by_hand())), ElementsAre(0, 0, 1, 2, 1));
  EXPECT_THAT(components({places(), {{3, 4, 1}, {0, 4, 1}, {1, 2, 1}}}),
              ElementsAre(0, 1, 1, 0, 0));
  EXPECT_TRUE(components({}).empty());
}

TEST(MeanEdgeLength, IsTheMeanOrAFallback) {
  EXPECT_DOUBLE_EQ(mean_edge_length(connect(places(), by_hand())), (1 + 3) / 2.0);
  EXPECT_DOUBLE_EQ(mean_edge_length({places(), {}}), 8);
  EXPECT_DOUBLE_EQ(mean_edge_length({Eigen::Vector3d(1, 2, 3), {}}), 1);
  EXPECT_DOUBLE_EQ(mean_edge_length({}), 1);
  EXPECT_DOUBLE_EQ(mean_edge_length({Eigen::Matrix3Xd::Ones(3, 2), {{0, 1, 1}}}), 1);
}

}  // namespace
}  // namespace deformlab::test
