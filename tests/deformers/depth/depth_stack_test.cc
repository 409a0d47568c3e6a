#include "deformers/depth/depth_stack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace deformlab::test {
namespace {

using ::testing::ElementsAre;

std::vector<int> numbers(int n) {
  std::vector<int> result(n);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

TEST(DepthStack, KeepsItsOrderWithoutConstraints) {
  const DepthStack stack({2, 0, 1});
  EXPECT_TRUE(stack.in_front(0, 2));
  EXPECT_TRUE(stack.in_front(1, 0));
  EXPECT_FALSE(stack.in_front(2, 1));
  EXPECT_THAT(stack.heights(), ElementsAre(0, 0, 0));
}

TEST(DepthStack, MovesWhatAConstraintConcerns) {
  DepthStack stack(numbers(5));
  EXPECT_TRUE(stack.put(3, 1));
  EXPECT_TRUE(stack.in_front(1, 3));
  EXPECT_TRUE(stack.in_front(2, 0));
  EXPECT_TRUE(stack.in_front(4, 1));
  EXPECT_THAT(stack.heights(), ElementsAre(0, 1, 0, 0, 0));
}

TEST(DepthStack, RefusesCircles) {
  DepthStack stack(numbers(3));
  EXPECT_FALSE(stack.put(1, 1));
  EXPECT_TRUE(stack.put(0, 1));
  EXPECT_TRUE(stack.put(1, 2));
  EXPECT_FALSE(stack.put(2, 0));
  EXPECT_EQ(stack.constraints(), 2u);
  EXPECT_THAT(stack.heights(), ElementsAre(0, 1, 2));
  stack.take_back_to(1);
  EXPECT_TRUE(stack.put(2, 0));
  EXPECT_TRUE(stack.in_front(0, 2));
  EXPECT_TRUE(stack.in_front(1, 0));
  EXPECT_FALSE(stack.put(1, 2));
}

TEST(DepthStack, ForgetsConstraintsAndKeepsTheOrder) {
  DepthStack stack(numbers(4));
  EXPECT_TRUE(stack.put(3, 0));
  stack.clear();
  EXPECT_EQ(stack.constraints(), 0u);
  EXPECT_TRUE(stack.in_front(0, 3));
  EXPECT_THAT(stack.heights(), ElementsAre(0, 0, 0, 0));
  EXPECT_TRUE(stack.put(0, 3));
  EXPECT_TRUE(stack.in_front(3, 0));
}

/// The same by a table of all pairs.
class Reference {
 public:
  explicit Reference(int n) : n_(n), links_(n, std::vector<int>(n, 0)) {}

  bool leads(int from, int to) const {
    std::vector<int> reached{from};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (reached[i] == to) return true;
      for (int k = 0; k < n_; ++k) {
        if (links_[reached[i]][k] > 0 && std::ranges::find(reached, k) == reached.end())
          reached.push_back(k);
      }
    }
    return false;
  }
  void link(int back, int front, int count) { links_[back][front] += count; }

  int height(int item) const {
    int result = 0;
    for (int k = 0; k < n_; ++k) {
      if (links_[k][item] > 0) result = std::max(result, height(k) + 1);
    }
    return result;
  }
  void expect_order_of(const DepthStack& stack) const {
    for (int a = 0; a < n_; ++a) {
      for (int b = 0; b < n_; ++b) {
        EXPECT_TRUE(links_[a][b] == 0 || stack.in_front(b, a));
        EXPECT_TRUE(a == b || stack.in_front(a, b) != stack.in_front(b, a));
      }
    }
  }

 private:
  int n_;
  std::vector<std::vector<int>> links_;
};

TEST(DepthStack, AgreesWithATableOfAllPairs) {
  std::mt19937 random(17);
  for (int n = 0; n < 40; ++n) {
    constexpr int kItems = 14;
    std::vector<int> order = numbers(kItems);
    std::ranges::shuffle(order, random);
    DepthStack stack(order);
    Reference reference(kItems);
    std::vector<std::pair<int, int>> put;
    for (int step = 0; step < 60; ++step) {
      if (random() % 8 == 0) {
        const std::size_t left = put.size() - std::min<std::size_t>(put.size(), random() % 6);
        stack.take_back_to(left);
        for (; put.size() > left; put.pop_back()) {
          reference.link(put.back().first, put.back().second, -1);
        }
      }
      const int back = static_cast<int>(random() % kItems);
      const int front = static_cast<int>(random() % kItems);
      const bool possible = !reference.leads(front, back);
      ASSERT_EQ(stack.put(back, front), possible);
      if (possible) {
        reference.link(back, front, 1);
        put.emplace_back(back, front);
      }
      ASSERT_EQ(stack.constraints(), put.size());
      reference.expect_order_of(stack);
    }
    const std::vector<int> heights = stack.heights();
    for (int i = 0; i < kItems; ++i) EXPECT_EQ(heights[i], reference.height(i));
  }
}

TEST(DepthStack, GivesUpRatherThanSearchForever) {
  // Each constraint against the order moves all items, and visits a quarter of a million of them.
  constexpr int kItems = 3000;
  DepthStack stack(numbers(kItems));
  int refused = 0;
  for (int k = 1; k < kItems; ++k) {
    for (int j = 0; j < k; j += 1 + k / 2) refused += !stack.put(k, j);
  }
  for (int k = 0; k + 1 < kItems; ++k) refused += !stack.put(k, k + 1);
  EXPECT_GT(refused, 0);
  stack.clear();
  EXPECT_TRUE(stack.put(0, 1));
  EXPECT_TRUE(stack.put(5, 4));
}

}  // namespace
}  // namespace deformlab::test
