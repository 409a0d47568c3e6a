#include "geometry/core/workers.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace deformlab {
namespace {

TEST(Workers, ThreadsDoEachPieceOnce) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<int> done(1000, 0);
    Workers(threads).each(1000, [&](int i) { done[i] += i; });
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(done[i], i) << threads;
  }
}

TEST(Workers, NoNumberMeansAllThreadsOfTheMachine) {
  EXPECT_EQ(Workers(0).threads(), static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_EQ(Workers(3).threads(), 3);
  EXPECT_EQ(Workers().threads(), 1);
}

}  // namespace
}  // namespace deformlab
