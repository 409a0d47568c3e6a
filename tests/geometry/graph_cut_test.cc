#include "geometry/graph/graph_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/errors.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refused(Eigen::Index vertices, const std::vector<int>& nodes,
                    const std::vector<Cut>& cuts) {
  return test::error_of([&] { group(vertices, nodes, cuts); });
}

TEST(Cut, WithoutCutsAllAreOneGroup) {
  const CutGroups groups = group(3, std::vector<int>{2, 0}, {});
  EXPECT_THAT(groups.of_vertex, ElementsAre(0, 0, 0));
  EXPECT_THAT(groups.of_node, ElementsAre(0, 0));
  ASSERT_EQ(groups.nodes.size(), 1u);
  EXPECT_THAT(groups.nodes[0], ElementsAre(0, 1));
}

TEST(Cut, TheTwoSidesAreApartAndTheRestFollowsBoth) {
  // Vertices 0, 1 against 4, 5; between them 2 and 3 on neither side. A node on 0, 2 and 5.
  const std::vector<Cut> cuts{{{0, 1}, {4, 5}}};
  const CutGroups groups = group(6, std::vector<int>{0, 2, 5}, cuts);
  EXPECT_THAT(groups.of_vertex, ElementsAre(0, 0, 1, 1, 2, 2));
  EXPECT_THAT(groups.of_node, ElementsAre(0, 1, 2));
  EXPECT_THAT(groups.nodes[0], ElementsAre(0, 1));
  EXPECT_THAT(groups.nodes[1], ElementsAre(0, 1, 2));
  EXPECT_THAT(groups.nodes[2], ElementsAre(1, 2));
  EXPECT_TRUE(groups.apart[0][2]);
  EXPECT_TRUE(groups.apart[2][0]);
  EXPECT_FALSE(groups.apart[0][1]);
  EXPECT_FALSE(groups.apart[1][2]);
}

TEST(Cut, SeveralCutsDivideFurther) {
  const std::vector<Cut> cuts{{{0, 1}, {2, 3}}, {{0, 2}, {1, 3}}};
  const CutGroups groups = group(4, std::vector<int>{0, 1, 2, 3}, cuts);
  EXPECT_THAT(groups.of_vertex, ElementsAre(0, 1, 2, 3));
  for (int g = 0; g < 4; ++g) EXPECT_THAT(groups.nodes[g], ElementsAre(g));
}

TEST(Cut, SidesThatCannotBe) {
  const std::vector<int> nodes{0, 5};
  EXPECT_THAT(refused(6, nodes, {{{0}, {}, "cut 1"}}),
              HasSubstr("cut 1: its side b has no vertex"));
  EXPECT_THAT(refused(6, nodes, {{{}, {0}, "cut 1"}}), HasSubstr("side a has no vertex"));
  EXPECT_THAT(refused(6, nodes, {{{0}, {6}, "cut 2"}}),
              AllOf(HasSubstr("cut 2: vertex 6 does not exist"), HasSubstr("6 vertices")));
  EXPECT_THAT(refused(6, nodes, {{{-1}, {0}}}), HasSubstr("vertex -1 does not exist"));
  EXPECT_THAT(refused(6, nodes, {{{0, 3}, {3, 5}, "cut"}}),
              HasSubstr("cut: vertex 3 is on both sides"));
}

TEST(Cut, AHandleThatIsSeparatedFromEveryNode) {
  // All nodes are on side b; vertex 2 alone would follow none.
  const std::vector<Cut> cuts{{{2}, {0, 1, 3, 4, 5}, "the hand"}};
  EXPECT_THAT(refused(6, {0, 5}, cuts),
              AllOf(HasSubstr("the hand: vertex 2 would have no node to follow"),
                    HasSubstr("all 2 nodes are on the other side"), HasSubstr("use more nodes")));
}

}  // namespace
}  // namespace deformlab::test
