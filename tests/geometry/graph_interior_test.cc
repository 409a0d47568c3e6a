#include "geometry/graph/placement/graph_interior.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/graph/graph_build.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

// A palm of 9×2×4 cubes with two fingers of 4×2×8 that are one cube apart.
bool is_in_hand(int x, int, int z) { return z < 4 || x < 4 || x > 4; }
Shape hand() { return cubes(9, 2, 12, is_in_hand); }

GraphOptions options_of(int nodes) {
  GraphOptions options;
  options.nodes = nodes;
  options.distance = NodeDistance::kPathAware;
  options.neighbors = 8;
  options.alpha = EdgeWeights::kLength;
  return options;
}

TEST(WhyOpen, TellsWhereASurfaceIsOpen) {
  EXPECT_EQ(why_open(hand()), std::nullopt);
  EXPECT_THAT(why_open(point_set(10)).value(), HasSubstr("no faces"));
  Shape open = hand();
  open.faces.pop_back();
  EXPECT_THAT(why_open(open).value(), HasSubstr("has 1 triangle"));
  EXPECT_THAT(why_open(bumpy_plane(4)).value(), HasSubstr("vertices 0 and 1"));
}

TEST(WhyOpen, ASeamIsNoOpening) {
  Shape seams = hand();  // every face gets corners of its own
  Eigen::Matrix3Xd V(3, 4 * std::ssize(seams.faces));
  int next = 0;
  for (auto& face : seams.faces) {
    for (int& i : face) V.col(next) = seams.V.col(i), i = next++;
  }
  seams.V = V;
  EXPECT_EQ(why_open(seams), std::nullopt);
}

class InteriorOfAHand : public ::testing::Test {
 protected:
  const Shape shape_ = hand();
  const DeformationGraph surface_ = build_graph(shape_, options_of(120)).graph;
  const DeformationGraph graph_ = with_interior(shape_, surface_, 1.0, EdgeWeights::kLength);
};

TEST_F(InteriorOfAHand, NodesAreAddedBehindTheOthers) {
  const Eigen::Index m = surface_.g.cols();
  ASSERT_GE(graph_.g.cols(), m + 10);
  EXPECT_EQ(graph_.g.leftCols(m), surface_.g);
  for (const GraphEdge& edge : surface_.edges) {
    EXPECT_TRUE(std::ranges::any_of(graph_.edges, [&](const GraphEdge& other) {
      return other.j == edge.j && other.k == edge.k;
    }));
  }
  std::vector<int> edges_of(graph_.g.cols(), 0);
  double sum = 0;
  for (const GraphEdge& edge : graph_.edges)
    ++edges_of[edge.j], ++edges_of[edge.k], sum += edge.alpha;
  EXPECT_GT(std::ranges::min(edges_of), 0);
  EXPECT_NEAR(sum / static_cast<double>(graph_.edges.size()), 1, 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(graph_.edges, {},
                                     [](const GraphEdge& e) { return std::pair(e.j, e.k); }));
}

TEST_F(InteriorOfAHand, NoEdgeLeavesTheShape) {
  const Eigen::Index m = surface_.g.cols();
  for (const GraphEdge& edge : graph_.edges) {
    if (edge.k < m) continue;
    const Eigen::Vector3d a = graph_.g.col(edge.j), b = graph_.g.col(edge.k);
    for (double share = 0.02; share <= 1; share += 0.02) {
      const Eigen::Vector3d p = a + share * (b - a);
      const Eigen::Array3i cell = p.array().floor().cast<int>();
      EXPECT_TRUE((p.array() >= 0).all() && (p.array() <= Eigen::Array3d(9, 2, 12)).all());
      EXPECT_TRUE(is_in_hand(cell[0], cell[1], cell[2])) << p.transpose();
    }
  }
}

TEST_F(InteriorOfAHand, IsTheSameAgain) {
  const DeformationGraph again = with_interior(shape_, surface_, 1.0, EdgeWeights::kLength);
  EXPECT_EQ(again.g, graph_.g);
  ASSERT_EQ(again.edges.size(), graph_.edges.size());
  for (std::size_t e = 0; e < again.edges.size(); ++e) {
    EXPECT_EQ(again.edges[e].k, graph_.edges[e].k);
    EXPECT_EQ(again.edges[e].alpha, graph_.edges[e].alpha);
  }
}

TEST(Interior, HasAtMostThreeNodesForEachOnTheSurface) {
  const Shape block = cubes(12, 12, 12, [](int, int, int) { return true; });
  const DeformationGraph graph = build_graph(block, options_of(200)).graph;
  const DeformationGraph fine = with_interior(block, graph, 0.3, EdgeWeights::kLength);
  EXPECT_LE(fine.g.cols(), 4 * graph.g.cols());
  EXPECT_GE(fine.g.cols(), 2 * graph.g.cols());
}

TEST(Interior, OfAThinShapeIsBetweenItsSides) {
  Shape thin = hand();
  thin.V.row(1) *= 1e-3;
  const DeformationGraph graph = build_graph(thin, options_of(60)).graph;
  const Eigen::Matrix3Xd g = with_interior(thin, graph, 1.6, EdgeWeights::kLength).g;
  ASSERT_GE(g.cols(), graph.g.cols());
  EXPECT_EQ(g.leftCols(graph.g.cols()), graph.g);
  EXPECT_GE(g.row(1).minCoeff(), thin.V.row(1).minCoeff());
  EXPECT_LE(g.row(1).maxCoeff(), thin.V.row(1).maxCoeff());
}

}  // namespace
}  // namespace deformlab::test
