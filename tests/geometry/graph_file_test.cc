#include "geometry/graph/graph_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "geometry/core/error.h"
#include "tests/support/errors.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

DeformationGraph reading(const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "graph.obj";
  std::ofstream(path, std::ios::binary) << text;
  return read_graph(path);
}

std::string refused(const std::string& text) {
  return test::error_of([&] { reading(text); });
}

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 2 0 0\n";

TEST(GraphFile, ReadsNodesAndEdges) {
  const DeformationGraph graph =
      reading("# by hand\no graph\n" + kThree + "v 0 3.5 -1e1\nl 4 2 1\nl -2 1\nusemtl red\n");
  ASSERT_EQ(graph.g.cols(), 4);
  EXPECT_EQ(graph.g.col(3), Eigen::Vector3d(0, 3.5, -10));
  ASSERT_EQ(graph.edges.size(), 3u);
  const int expected[3][2] = {{0, 1}, {0, 2}, {1, 3}};
  for (int e = 0; e < 3; ++e) {
    EXPECT_EQ(graph.edges[e].j, expected[e][0]) << e;
    EXPECT_EQ(graph.edges[e].k, expected[e][1]) << e;
    EXPECT_EQ(graph.edges[e].alpha, 1) << e;
  }
}

TEST(GraphFile, NodesMayComeAfterTheirEdges) {
  EXPECT_EQ(reading("l 1 2\nv 0 0 0\r\nv 1 0 0\r\n").edges.size(), 1u);
}

TEST(GraphFile, OneNodeNeedsNoEdge) {
  EXPECT_EQ(reading("v 1 2 3").g.cols(), 1);
  EXPECT_TRUE(reading("v 1 2 3").edges.empty());
}

TEST(GraphFile, AnIsolatedNode) {
  EXPECT_THAT(refused(kThree + "l 1 2\n"),
              AllOf(HasSubstr("graph.obj"), HasSubstr("node 3 (line 3) is isolated")));
}

TEST(GraphFile, ARepeatedNode) {
  EXPECT_THAT(refused(kThree + "v 1 -0 0\nl 1 2 3 4\n"),
              HasSubstr("node 4 (line 4) is repeated: node 2 (line 2) is at the same place"));
}

TEST(GraphFile, AnEdgeThatLeadsNowhere) {
  EXPECT_THAT(refused(kThree + "l 1 2 4\n"),
              AllOf(HasSubstr("line 4: the edge from node 2 to node 4 leads nowhere"),
                    HasSubstr("there are 3 nodes")));
  EXPECT_THAT(refused(kThree + "l 1 -4\n"),
              HasSubstr("line 4: an edge to '-4' leads nowhere: so far there are 3 nodes"));
  for (const char* end : {"0", "x", "1.5", "99999999999", "99999999999999999999", "/2"}) {
    EXPECT_THAT(refused(kThree + "l 1 " + end + "\n"),
                AllOf(HasSubstr("line 4"), HasSubstr("is not a node")))
        << end;
  }
}

TEST(GraphFile, EdgesThatSayNothing) {
  EXPECT_THAT(refused(kThree + "l 1 2 2 3\n"), HasSubstr("joins node 2 to itself"));
  EXPECT_THAT(refused(kThree + "l 1 2 3\nl 2 1\n"),
              HasSubstr("line 5: the edge between node 1 and node 2 is repeated: line 4 has it"));
  EXPECT_THAT(refused(kThree + "l 1\n"), HasSubstr("an edge joins two nodes or more"));
  EXPECT_THAT(refused(kThree + "f 1 2 3\n"), HasSubstr("a face is no edge"));
}

TEST(GraphFile, NodesThatCannotBe) {
  EXPECT_THAT(refused("v 0 0\n"), HasSubstr("node 1 (line 1) has fewer than 3 coordinates"));
  for (const char* bad : {"nan", "inf", "1e999", "zero"}) {
    EXPECT_THAT(refused("v 0 " + std::string(bad) + " 0\n"), HasSubstr("node 1 (line 1)")) << bad;
  }
  // Its squared distance to anything is no number any more.
  EXPECT_THAT(refused("v 0 0 0\nv 0 -1e200 0\nl 1 2\n"),
              AllOf(HasSubstr("node 2 (line 2)"), HasSubstr("1e+200"), HasSubstr("1e+50")));
}

TEST(GraphFile, FilesThatAreNone) {
  EXPECT_THAT(refused(""), HasSubstr("it is empty"));
  EXPECT_THAT(refused("hello\n"), HasSubstr("it has no node"));
  using namespace std::string_literals;
  EXPECT_THAT(refused("\0\xff\xfe v \n\0l 1 2"s), HasSubstr("it has no node"));
  EXPECT_THROW(read_graph("/nonexistent/graph.obj"), InputError);
  EXPECT_THROW(read_graph(::testing::TempDir()), InputError);
}

}  // namespace
}  // namespace deformlab::test
