#include "deformers/depth/depth_memory.h"

#include <gtest/gtest.h>

namespace deformlab::test {
namespace {

using Region = std::vector<TrianglePair>;

Overlaps overlaps(const std::vector<Region>& regions) {
  Overlaps result;
  for (const Region& region : regions) {
    result.regions.push_back(
        {static_cast<int>(result.pairs.size()), static_cast<int>(region.size())});
    result.pairs.insert(result.pairs.end(), region.begin(), region.end());
  }
  return result;
}

TEST(DepthMemory, KnowsNothingAtFirstAndOnceItForgot) {
  DepthMemory memory;
  const Overlaps one = overlaps({{{1, 2, 5}}});
  EXPECT_EQ(memory.recall(one)[0].vote, 0);
  EXPECT_FALSE(memory.recall(one)[0].lasting);
  memory.keep(one, {true});
  EXPECT_EQ(memory.recall(one)[0].vote, 5);
  memory.forget();
  EXPECT_EQ(memory.recall(one)[0].vote, 0);
  EXPECT_FALSE(memory.recall(one)[0].lasting);
  EXPECT_TRUE(memory.recall({}).empty());
}

TEST(DepthMemory, VotesByTheAreaOfPairsThatLast) {
  DepthMemory memory;
  memory.keep(overlaps({{{1, 2, 5}, {3, 4, 7}}}), {true, false});
  // The areas differ, one pair is named the other way round, and one pair is new.
  const auto recalled =
      memory.recall(overlaps({{{2, 1, 10}, {3, 4, 1}, {5, 6, 100}}, {{7, 8, 1}}}));
  EXPECT_TRUE(recalled[0].lasting);
  EXPECT_EQ(recalled[0].vote, -10 - 1);
  EXPECT_FALSE(recalled[1].lasting);
  EXPECT_EQ(recalled[1].vote, 0);
}

TEST(DepthMemory, TellsWhereRegionsOfBothOrdersHaveBecomeOne) {
  DepthMemory memory;
  memory.keep(overlaps({{{1, 2, 5}}, {{3, 4, 7}}}), {true, false});
  const auto recalled = memory.recall(overlaps({{{1, 2, 5}, {1, 4, 1}, {3, 4, 7}}, {{8, 9, 1}}}));
  EXPECT_TRUE(recalled[0].mixed);
  EXPECT_EQ(recalled[0].vote, 5 - 7);
  EXPECT_FALSE(recalled[1].mixed);
  EXPECT_EQ(memory.side(1, 2), 1);
  EXPECT_EQ(memory.side(2, 1), -1);
  EXPECT_EQ(memory.side(3, 4), -1);
  EXPECT_EQ(memory.side(1, 4), 0);
}

TEST(DepthMemory, ASmallPartOfAnotherOrderIsOutvoted) {
  DepthMemory memory;
  memory.keep(overlaps({{{1, 2, 5}}, {{3, 4, 100}}}), {true, false});
  EXPECT_FALSE(memory.recall(overlaps({{{1, 2, 5}, {3, 4, 100}}}))[0].mixed);
  EXPECT_TRUE(memory.recall(overlaps({{{1, 2, 5}, {3, 4, 10}}}))[0].mixed);
}

TEST(DepthMemory, PassesOnWhatWasInFrontInARegionThatIsGone) {
  DepthMemory memory;
  memory.keep(overlaps({{{1, 2, 5}}, {{3, 4, 5}}}), {true, true});
  // The overlap of 1 over 2 is gone, that of 3 over 4 is not. So a new region of 1 continues the
  // first one, and a new region of 3 alone does not continue the second.
  const auto recalled =
      memory.recall(overlaps({{{3, 4, 2}}, {{1, 9, 2}}, {{9, 2, 4}}, {{3, 9, 2}}, {{99, 98, 1}}}));
  EXPECT_EQ(recalled[0].vote, 2);
  EXPECT_TRUE(recalled[0].lasting);
  EXPECT_EQ(recalled[1].vote, 2);
  EXPECT_FALSE(recalled[1].lasting);
  EXPECT_EQ(recalled[2].vote, 4);
  EXPECT_EQ(recalled[3].vote, 0);
  EXPECT_EQ(recalled[4].vote, 0);
}

}  // namespace
}  // namespace deformlab::test
