#include "geometry/graph/graph_build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "geometry/core/error.h"
#include "geometry/graph/graph_vertices.h"
#include "geometry/transfer/geodesic.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

GraphOptions with(NodePlacement method, int nodes,
                  NodeDistance distance = NodeDistance::kEuclidean) {
  GraphOptions options;
  options.method = method;
  options.nodes = nodes;
  options.distance = distance;
  return options;
}

GraphOptions with_file(const std::string& text) {
  GraphOptions options = with(NodePlacement::kFile, 300);
  options.file = std::filesystem::path(::testing::TempDir()) / "graph_build.obj";
  std::ofstream(options.file, std::ios::binary) << text;
  return options;
}

std::string refused(const Shape& shape, const GraphOptions& options,
                    const std::vector<Cut>& cuts = {}) {
  return test::error_of([&] { build_graph(shape, options, cuts); });
}

// What every graph promises.
void expect_sound(const BuiltGraph& built, const Shape& shape) {
  const auto m = built.graph.g.cols();
  const Embedding& e = built.embedding;
  EXPECT_EQ(e.v, shape.V);
  ASSERT_EQ(e.nodes.cols(), shape.V.cols());
  EXPECT_GE(e.nodes.minCoeff(), 0);
  EXPECT_LT(e.nodes.maxCoeff(), m);
  EXPECT_GE(e.weights.minCoeff(), 0);
  EXPECT_LT((e.weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  for (const auto nodes : e.nodes.colwise()) {
    EXPECT_EQ(std::set<int>(nodes.begin(), nodes.end()).size(), std::size_t(nodes.size()));
  }
  std::set<std::pair<int, int>> seen;
  for (const GraphEdge& edge : built.graph.edges) {
    EXPECT_LT(edge.j, edge.k);
    EXPECT_LT(edge.k, m);
    EXPECT_TRUE(seen.insert({edge.j, edge.k}).second);
  }
  for (std::size_t j = 0; j < built.node_vertices.size(); ++j) {
    EXPECT_GE(built.node_vertices[j], 0);
    EXPECT_LT(built.node_vertices[j], shape.V.cols());
  }
}

// A sheet folded in two, the halves 0.02 apart: vertices 0 … 20 of each row lie in the lower half.
Shape folded_sheet() {
  Shape sheet = bumpy_plane(41, 1, 0);
  for (auto v : sheet.V.colwise()) {
    if (v.x() > 0.5) v = Eigen::Vector3d(1 - v.x(), v.y(), 0.02);
  }
  sheet.N.resize(3, 0);
  return sheet;
}

// The vertices whose places on the flat sheet are up to x, and from there on.
std::pair<std::vector<int>, std::vector<int>> halves(double until, double from) {
  std::pair<std::vector<int>, std::vector<int>> result;
  for (int i = 0; i < 41 * 41; ++i) {
    const double x = (i % 41) / 40.0;
    if (x <= until) result.first.push_back(i);
    if (x >= from) result.second.push_back(i);
  }
  return result;
}

TEST(BuildGraph, EveryMethodAndDistanceGivesASoundGraph) {
  const Shape plane = bumpy_plane(25);
  for (const NodePlacement method :
       {NodePlacement::kSampling, NodePlacement::kSimplification, NodePlacement::kGrid}) {
    for (const NodeDistance distance :
         {NodeDistance::kEuclidean, NodeDistance::kGeodesic, NodeDistance::kEdgePaths}) {
      SCOPED_TRACE(::testing::Message() << method << ", " << distance);
      const BuiltGraph built = build_graph(plane, with(method, 36, distance));
      EXPECT_EQ(built.graph.g.cols(), 36);
      expect_sound(built, plane);
      EXPECT_THAT(built.notes, IsEmpty());
      EXPECT_EQ(built.in_space, distance == NodeDistance::kEuclidean);
      EXPECT_EQ(std::ranges::max(components(built.graph)), 0);
      const bool samples_space = method == NodePlacement::kSampling && built.in_space;
      EXPECT_EQ(built.node_vertices.empty(), samples_space);
      for (std::size_t j = 0; j < built.node_vertices.size(); ++j) {
        EXPECT_EQ(built.graph.g.col(j), plane.V.col(built.node_vertices[j]));
      }
      const BuiltGraph again = build_graph(plane, with(method, 36, distance));
      EXPECT_EQ(again.graph.g, built.graph.g);
      EXPECT_EQ(again.embedding.weights, built.embedding.weights);
    }
  }
}

TEST(BuildGraph, AlongASurfaceOnlyThatSideIsFollowed) {
  const Shape sheet = folded_sheet();
  const auto across = [&](NodeDistance distance) {
    const BuiltGraph built = build_graph(sheet, with(NodePlacement::kSimplification, 60, distance));
    expect_sound(built, sheet);
    int count = 0;
    for (Eigen::Index i = 0; i < sheet.V.cols(); ++i) {
      const double x = (i % 41) / 40.0;
      for (Eigen::Index a = 0; a < built.embedding.nodes.rows(); ++a) {
        const int v = built.node_vertices[built.embedding.nodes(a, i)];
        const bool far = std::abs((v % 41) / 40.0 - x) > 0.45;
        count += far && built.embedding.weights(a, i) > 0;
      }
    }
    return count;
  };
  EXPECT_GT(across(NodeDistance::kEuclidean), 100);
  EXPECT_EQ(across(NodeDistance::kGeodesic), 0);
  EXPECT_EQ(across(NodeDistance::kEdgePaths), 0);
}

TEST(BuildGraph, ACutKeepsTheSidesApart) {
  const Shape sheet = folded_sheet();
  const auto [a, b] = halves(0.4, 0.6);
  const std::vector<Cut> cuts{{a, b}};
  std::vector<char> side(sheet.V.cols(), ' ');
  for (const int i : a) side[i] = 'a';
  for (const int i : b) side[i] = 'b';
  for (const NodeDistance distance :
       {NodeDistance::kEuclidean, NodeDistance::kGeodesic, NodeDistance::kEdgePaths}) {
    SCOPED_TRACE(::testing::Message() << distance);
    const BuiltGraph built =
        build_graph(sheet, with(NodePlacement::kSimplification, 60, distance), cuts);
    expect_sound(built, sheet);
    EXPECT_FALSE(built.in_space);
    const auto apart = [&](int v, int w) {
      return side[v] != ' ' && side[w] != ' ' && side[v] != side[w];
    };
    for (const GraphEdge& edge : built.graph.edges) {
      EXPECT_FALSE(apart(built.node_vertices[edge.j], built.node_vertices[edge.k]));
    }
    for (int i = 0; i < sheet.V.cols(); ++i) {
      for (Eigen::Index r = 0; r < built.embedding.nodes.rows(); ++r) {
        if (built.embedding.weights(r, i) == 0) continue;
        EXPECT_FALSE(apart(i, built.node_vertices[built.embedding.nodes(r, i)]));
      }
    }
    EXPECT_THAT(built.notes, IsEmpty());  // the strip between the sides still joins them
  }
}

TEST(BuildGraph, ACutThroughTheWholeShapeIsNoted) {
  const auto [a, b] = halves(0.5, 0.51);
  const BuiltGraph built =
      build_graph(folded_sheet(), with(NodePlacement::kSampling, 60), std::vector<Cut>{{a, b}});
  EXPECT_THAT(built.notes, Contains(HasSubstr("in 2 parts instead of 1")));
}

TEST(BuildGraph, ACutThatLeavesAHandleWithoutANode) {
  std::vector<int> rest;
  for (int i = 0; i < 41 * 41; ++i) {
    if (i != 17) rest.push_back(i);
  }
  GraphOptions options = with(NodePlacement::kGrid, 36);
  EXPECT_THAT(refused(folded_sheet(), options, {{{17}, rest, "cut 1"}}),
              HasSubstr("cut 1: vertex 17 would have no node to follow"));
}

TEST(BuildGraph, TakesAGraphMadeByHand) {
  const Shape plane = bumpy_plane(11);
  const std::string nodes = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\n";
  const BuiltGraph built = build_graph(plane, with_file(nodes + "l 1 2 3 4\nl 5 1\n"));
  expect_sound(built, plane);
  ASSERT_EQ(built.graph.edges.size(), 4u);  // those of the file, not those of co-influence
  EXPECT_EQ(built.graph.edges[1].j, 0);
  EXPECT_EQ(built.graph.edges[1].k, 4);
  for (const GraphEdge& edge : built.graph.edges) EXPECT_EQ(edge.alpha, 1);
}

TEST(BuildGraph, EdgesByHandWithoutOverlapJoinNothingWhereOverlapWeighs) {
  // Two clusters of nodes far from each other: no vertex follows nodes of both.
  const Shape two = side_by_side(bumpy_plane(9), bumpy_plane(9), {50, 0, 0});
  std::string text;
  for (const int x : {0, 50}) {
    for (const char* at : {".2 .2", ".8 .2", ".2 .8", ".8 .8", ".5 .5"}) {
      const std::string corner = at;
      text += "v " + std::to_string(x) + corner.substr(0, 2) + corner.substr(2) + " 0\n";
    }
  }
  GraphOptions options = with_file(text + "l 1 2 3 4 5\nl 6 7 8 9 10\nl 1 6\n");
  EXPECT_EQ(std::ranges::max(components(build_graph(two, options).graph)), 0);
  options.alpha = EdgeWeights::kOverlap;
  const BuiltGraph built = build_graph(two, options);
  EXPECT_EQ(std::ranges::max(components(built.graph)), 1);
  EXPECT_THAT(built.notes, Contains(HasSubstr("edges that join nodes without a common vertex")));
  double sum = 0;
  for (const GraphEdge& edge : built.graph.edges) {
    EXPECT_GT(edge.alpha, 0);
    sum += edge.alpha;
  }
  EXPECT_NEAR(sum / double(built.graph.edges.size()), 1, 1e-14);
}

TEST(BuildGraph, EdgesByHandAreWeighedByTheirLengthWhereThatIsAskedFor) {
  GraphOptions options = with_file("v 0 0 0\nv 1 0 0\nv 1 3 0\nv 0 3 0\nl 1 2 3 4\n");
  options.alpha = EdgeWeights::kLength;
  const BuiltGraph built = build_graph(bumpy_plane(9), options);
  ASSERT_EQ(built.graph.edges.size(), 3u);
  EXPECT_NEAR(built.graph.edges[0].alpha, 9 * built.graph.edges[1].alpha, 1e-12);
  EXPECT_NEAR(built.graph.edges[0].alpha + built.graph.edges[1].alpha + built.graph.edges[2].alpha,
              3, 1e-12);
}

TEST(BuildGraph, FilesThatDoNotGoWithTheMethod) {
  EXPECT_THAT(refused(bumpy_plane(9), with(NodePlacement::kFile, 5)),
              HasSubstr("method is file, but the option file names none"));
  GraphOptions options = with_file("v 0 0 0\n");
  options.method = NodePlacement::kGrid;
  EXPECT_THAT(refused(bumpy_plane(9), options), HasSubstr("but method is grid"));
  EXPECT_THAT(refused(bumpy_plane(9), with_file("v 0 0 0\nv 1 0 0\n")), HasSubstr("isolated"));
}

TEST(BuildGraph, OptionsOutOfRangeAreNamedAsInTheirStruct) {
  const Shape plane = bumpy_plane(9);
  GraphOptions options = with(NodePlacement::kSampling, 20);
  options.neighbors = 17;
  EXPECT_EQ(refused(plane, options), "neighbors is 17; allowed: 1 to 16");
  options = with(NodePlacement::kGrid, 0);
  EXPECT_EQ(refused(plane, options), "nodes is 0; allowed: 1 to 100000");
  options = with(NodePlacement::kSimplification, 20);
  options.aspect_ratio = 0.5;
  EXPECT_EQ(refused(plane, options), "aspect_ratio is 0.5; allowed: at least 1");
}

TEST(BuildGraph, ShapesThatDoNotGoWithTheOptions) {
  EXPECT_THAT(refused(point_set(50), with(NodePlacement::kSampling, 20, NodeDistance::kGeodesic)),
              HasSubstr("no faces"));
  EXPECT_THAT(refused(point_set(50), with(NodePlacement::kSimplification, 20)),
              HasSubstr("no faces"));
  EXPECT_THAT(refused(bumpy_plane(4), with(NodePlacement::kSampling, 17, NodeDistance::kEdgePaths)),
              AllOf(HasSubstr("nodes is 17"), HasSubstr("16 vertices")));
  for (const NodePlacement method :
       {NodePlacement::kSampling, NodePlacement::kSimplification, NodePlacement::kGrid}) {
    EXPECT_NE(refused(Shape{}, with(method, 5)), "") << method;
    Shape broken = bumpy_plane(9);
    broken.V(1, 3) = NAN;
    EXPECT_THAT(refused(broken, with(method, 5)), HasSubstr("vertex 3")) << method;
  }
}

TEST(BuildGraph, NodesThatCannotBe) {
  const auto refused = [](const Eigen::Matrix3Xd& nodes) -> std::string {
    return test::error_of([&] { build_graph(bumpy_plane(5), nodes, {}); });
  };
  EXPECT_THAT(refused(Eigen::Matrix3Xd(3, 0)), HasSubstr("without nodes"));
  Eigen::Matrix3Xd nodes = bumpy_plane(3).V;
  for (const double bad : {double(NAN), double(INFINITY), 1e200}) {
    nodes(1, 4) = bad;
    EXPECT_THAT(refused(nodes), HasSubstr("'the nodes'")) << bad;
  }
}

TEST(BuildGraph, PartsWithoutANodeFollowThoseNearestInSpace) {
  const Shape two = side_by_side(bumpy_plane(9), bumpy_plane(9), {0, 0, 1});
  const Eigen::Matrix3Xd nodes = bumpy_plane(9).V(Eigen::all, std::vector<int>{0, 8, 40, 72, 80});
  for (const NodeDistance distance : {NodeDistance::kGeodesic, NodeDistance::kEdgePaths}) {
    const BuiltGraph built = build_graph(two, nodes, with(NodePlacement::kSampling, 5, distance));
    expect_sound(built, two);
    EXPECT_THAT(built.notes, Contains(HasSubstr("nearest in space: 81")));
  }
}

TEST(BuildGraph, FewNodesOfAPartAreFollowedByFewer) {
  // One node on the second plane: what lies there follows it alone, and it is joined to none.
  const Shape two = side_by_side(bumpy_plane(9), bumpy_plane(9), {0, 0, 0.1});
  const Eigen::Matrix3Xd nodes = two.V(Eigen::all, std::vector<int>{0, 8, 40, 72, 80, 81 + 40});
  for (const NodeDistance distance : {NodeDistance::kGeodesic, NodeDistance::kEdgePaths}) {
    const BuiltGraph built = build_graph(two, nodes, with(NodePlacement::kSampling, 6, distance));
    expect_sound(built, two);
    for (int i = 81; i < 162; ++i) {
      EXPECT_EQ(built.embedding.nodes(0, i), 5);
      EXPECT_EQ(built.embedding.weights(0, i), 1);
    }
    for (const GraphEdge& edge : built.graph.edges) EXPECT_LT(edge.k, 5);
  }
}

TEST(DistinctNearestVertices, GiveEachPointOneOfItsOwn) {
  const Eigen::Matrix3Xd V = bumpy_plane(4).V;
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 16);
  std::vector<int> found = distinct_nearest_vertices(points, V);
  EXPECT_EQ(found.front(), 0);
  std::sort(found.begin(), found.end());
  for (int i = 0; i < 16; ++i) EXPECT_EQ(found[i], i);
  EXPECT_THROW(distinct_nearest_vertices(Eigen::Matrix3Xd::Zero(3, 17), V), InputError);
}

}  // namespace
}  // namespace deformlab::test
