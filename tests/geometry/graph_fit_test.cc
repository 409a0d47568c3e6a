#include "geometry/graph/graph_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "geometry/graph/active_part.h"
#include "geometry/transfer/geodesic.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::Each;
using ::testing::Lt;

GraphOptions fitting(int nodes) {
  GraphOptions options;
  options.nodes = nodes;
  options.fit = true;
  options.distance = NodeDistance::kPathAware;
  options.neighbors = 8;
  options.alpha = EdgeWeights::kLength;
  return options;
}

int pieces(const DeformationGraph& graph) { return 1 + std::ranges::max(components(graph)); }

int nodes_of_points(int points, int most) {
  const Shape shape = point_set(points);
  return fitting_nodes(WeldedSurface(shape), most);
}

TEST(GraphFit, TheNumberOfNodesFollowsTheVertices) {
  EXPECT_EQ(nodes_of_points(30, 300), 30);
  EXPECT_EQ(nodes_of_points(100, 300), 50);
  EXPECT_EQ(nodes_of_points(1000, 300), 250);
  EXPECT_EQ(nodes_of_points(2000, 300), 300);
  EXPECT_EQ(nodes_of_points(2000, 20), 20);
}

TEST(GraphFit, TheGraphOfAConnectedShapeIsConnected) {
  for (const int rings : {2, 5, 10, 40}) {
    const Shape shape = tube(rings);
    for (const int nodes : {3, 10, 300}) {
      GraphOptions options = fitting(nodes);
      for (options.seed = 1; options.seed <= 5; ++options.seed) {
        EXPECT_EQ(pieces(build_graph(shape, options).graph), 1) << rings << " " << nodes;
        options.neighbors = options.seed % 2 == 0 ? 2 : 8;
      }
    }
  }
}

TEST(GraphFit, PointsWithoutFacesGetNodesBesideASurface) {
  const Shape points = point_set(400);
  Shape shape = points;
  shape.faces.push_back({0, 1, 2});
  const BuiltGraph built = build_graph(shape, fitting(60));
  // Without these nodes, all would be on the one triangle.
  EXPECT_GT(bounding_box_diagonal(built.graph.g), 0.8 * bounding_box_diagonal(points.V));
}

TEST(GraphFit, NodesThatNoVertexFollowsAreLeftOut) {
  const Shape shape = bumpy_plane(5);
  Eigen::Matrix3Xd nodes(3, 10);
  nodes << shape.V.leftCols<9>(), Eigen::Vector3d(50, 50, 50);
  GraphOptions options = fitting(10);
  options.distance = NodeDistance::kEuclidean;
  options.neighbors = 4;
  const BuiltGraph built = build_graph(shape, nodes, options);
  EXPECT_EQ(built.graph.g.cols(), 9);
  EXPECT_LT(built.embedding.nodes.maxCoeff(), 9);
}

TEST(ActivePart, IsWhatIsFreeAndAMargin) {
  const Shape plane = bumpy_plane(101, 1, 0);
  std::vector<int> fixed;
  for (int i = 0; i < plane.V.cols(); ++i) {
    if ((plane.V.col(i).head<2>() - Eigen::Vector2d(0.5, 0.5)).norm() > 0.1) fixed.push_back(i);
  }
  const ActivePart part = active_part(plane, fixed, 100);
  std::vector<double> away;
  for (const int i : part.vertices) {
    away.push_back((plane.V.col(i).head<2>() - Eigen::Vector2d(0.5, 0.5)).norm());
  }
  EXPECT_THAT(away, Each(Lt(0.1 + 6 * 0.018 * std::numbers::sqrt2)));
  EXPECT_GT(std::ranges::max(away), 0.1 + 2 * 0.017);
}

TEST(ActivePart, KeepsTheNeighboursOfFreeVerticesOnACoarseMesh) {
  const Shape plane = bumpy_plane(4, 1, 0);
  std::vector<int> fixed(16);
  std::iota(fixed.begin(), fixed.end(), 0);
  fixed.pop_back();  // one corner is free
  const ActivePart part = active_part(plane, fixed, 100'000);
  EXPECT_GE(part.vertices.size(), 3u);
  EXPECT_FALSE(part.shape.faces.empty());
}

TEST(ActivePart, OfAShapeWhereNothingOrAllIsFixedIsTheWhole) {
  const Shape plane = bumpy_plane(5);
  std::vector<int> all(25);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_TRUE(active_part(plane, {}, 10).is_whole(plane));
  EXPECT_TRUE(active_part(plane, all, 10).is_whole(plane));
}

}  // namespace
}  // namespace deformlab::test
