#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "geometry/graph/graph_build.h"
#include "geometry/graph/placement/sampling.h"
#include "geometry/plane/locator.h"
#include "geometry/transfer/geodesic.h"
#include "geometry/transfer/transfer.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

// What a caller of the library may get wrong is refused, and never read or written out of bounds.
namespace deformlab::test {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

DeformationGraph two_nodes() {
  Eigen::Matrix3Xd g = Eigen::Matrix3Xd::Zero(3, 2);
  g(0, 1) = 1;
  return {g, {{0, 1, 1}}};
}

TEST(Misuse, OfAnEdgeToANodeThatIsNotThere) {
  const Shape shape = bumpy_plane(5);
  for (const int k : {-1, 0, 2, 1'000'000}) {
    DeformationGraph graph = two_nodes();
    graph.edges[0].k = k;
    const std::string expected = "the nodes 0 and " + std::to_string(k);
    EXPECT_THAT(error_of([&] { check(graph); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { components(graph); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { mean_edge_length(graph); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { weigh_by_length(graph); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { build_graph(shape, graph, {}); }), HasSubstr(expected));
  }
}

TEST(Misuse, OfNodesAndWeightsThatAreNotFinite) {
  DeformationGraph graph = two_nodes();
  graph.g(1, 1) = kNaN;
  EXPECT_THAT(error_of([&] { check(graph); }), HasSubstr("node 1 of the graph"));
  EXPECT_THAT(error_of([&] { embed(Eigen::Vector3d::Zero(), graph.g, 4); }),
              HasSubstr("not finite"));
  for (const double alpha : {kNaN, -1.0, HUGE_VAL}) {
    graph = two_nodes();
    graph.edges[0].alpha = alpha;
    EXPECT_THAT(error_of([&] { check(graph); }), HasSubstr("has the weight"));
  }
}

TEST(Misuse, OfEmbeddings) {
  const DeformationGraph graph = two_nodes();
  const Embedding good = embed(Eigen::Matrix3Xd::Zero(3, 3), graph.g, 1);
  Embedding bad = good;
  bad.nodes(0, 2) = 2;
  EXPECT_THAT(error_of([&] { connect(graph.g, bad); }), HasSubstr("node 2"));
  bad = good;
  bad.weights.conservativeResize(1, 2);
  EXPECT_THAT(error_of([&] { connect(graph.g, bad); }), HasSubstr("1x2 weights"));
  EXPECT_THAT(error_of([&] { transfer_positions(rest_transformations(2), graph.g, bad); }),
              HasSubstr("do not fit together"));
  EXPECT_THAT(error_of([&] { connect(graph.g, good, {}, std::vector<int>(2, 1)); }),
              HasSubstr("2 numbers of nodes that count for 3 points"));
  EXPECT_THAT(error_of([&] { subset(good, std::vector<int>{0, 3}); }), HasSubstr("point 3"));
  const Embedding wider = embed(Eigen::Matrix3Xd::Zero(3, 1), bumpy_plane(3).V, 4);
  EXPECT_THAT(error_of([&] { joined(good, wider); }), HasSubstr("1 and 4 nodes"));
}

TEST(Misuse, OfTransfers) {
  const DeformationGraph graph = two_nodes();
  const Embedding points = embed(Eigen::Matrix3Xd::Zero(3, 3), graph.g, 1);
  for (const int m : {0, 1, 3}) {
    EXPECT_THAT(error_of([&] { transfer_positions(rest_transformations(m), graph.g, points); }),
                HasSubstr(std::to_string(4 * m) + " columns of transformations"));
  }
  const Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Ones(3, 2);
  EXPECT_THAT(error_of([&] { transfer_normals(rest_transformations(2), normals, points); }),
              HasSubstr("do not fit together"));
}

TEST(Misuse, OfFacesThatNameAVertexThatIsNotThere) {
  for (const int v : {-1, 25}) {
    Shape shape = bumpy_plane(5);
    shape.faces[3] = {0, 1, v};
    const std::string expected = "face 3 names vertex " + std::to_string(v);
    EXPECT_THAT(error_of([&] { triangles(shape); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { vertex_normals(shape); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { connected_parts(shape); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { sample_nodes(shape, 5, 1); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { nearest_along_edges(shape, std::vector<int>{0}, 1); }),
                HasSubstr(expected));
  }
}

TEST(Misuse, OfSourcesThatAreNotThere) {
  const Shape shape = bumpy_plane(5);
  for (const int v : {-1, 25}) {
    const std::vector<int> sources = {3, v};
    const std::string expected = "vertex " + std::to_string(v);
    EXPECT_THAT(error_of([&] { nearest_along_edges(shape, sources, 1); }), HasSubstr(expected));
    EXPECT_THAT(error_of([&] { nearest_along_surface(shape, sources, 1); }), HasSubstr(expected));
  }
}

TEST(Misuse, OfShapesThatAreNotFinite) {
  Shape shape = bumpy_plane(5);
  shape.V(0, 7) = kNaN;
  EXPECT_THAT(error_of([&] { sample_nodes(shape, 5, 1); }), HasSubstr("vertex 7"));
  EXPECT_THAT(error_of([&] { sample_nodes({}, 5, 1); }), HasSubstr("no vertices"));
}

TEST(Misuse, OfTriangulations) {
  Triangulation good;
  good.V.resize(2, 3);
  good.V << 0, 1, 0, 0, 0, 1;
  good.F = Eigen::Vector3i(0, 1, 2);
  const auto errors = [](const Triangulation& mesh) {
    return std::vector<std::string>{error_of([&] { quality(mesh); }),
                                    error_of([&] { to_shape(mesh); }),
                                    error_of([&] { Locator locator(mesh); })};
  };
  for (const int v : {-1, 3}) {
    Triangulation bad = good;
    bad.F(2, 0) = v;
    EXPECT_THAT(errors(bad), testing::Each(HasSubstr("names a vertex")));
  }
  Triangulation bad = good;
  bad.V(0, 1) = kNaN;
  EXPECT_THAT(errors(bad), testing::Each(HasSubstr("vertex 1 of the mesh")));
}

}  // namespace
}  // namespace deformlab::test
