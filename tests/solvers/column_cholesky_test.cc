#include "solvers/linear/column_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <functional>
#include <random>

namespace deformlab::test {
namespace {

/// The lower triangle of a random positive definite matrix with about so many entries.
SparseMatrix random_lower(int n, int entries, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<int> index(0, n - 1);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int i = 0; i < entries; ++i) {
    const int a = index(random), b = index(random);
    if (a == b) continue;
    const double v = value(random);
    triplets.emplace_back(std::max(a, b), std::min(a, b), v);
    triplets.emplace_back(a, a, 1.1 * std::abs(v));
    triplets.emplace_back(b, b, 1.1 * std::abs(v));
  }
  for (int i = 0; i < n; ++i) triplets.emplace_back(i, i, 0.1);
  SparseMatrix lower(n, n);
  lower.setFromTriplets(triplets.begin(), triplets.end());
  return lower;
}

Eigen::MatrixXd dense(const SparseMatrix& lower) {
  Eigen::MatrixXd A = lower;
  A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
  return A;
}

TEST(ColumnCholesky, SolvesAsADenseFactorDoes) {
  for (const int n : {1, 2, 3, 4, 5, 9, 40, 150}) {
    for (const int entries : {0, n, 3 * n, n * n}) {
      const SparseMatrix lower = random_lower(n, entries, n + entries);
      ColumnCholesky factor;
      ASSERT_TRUE(factor.factorize(lower)) << n << " " << entries;
      const ColumnBlock b = ColumnBlock::Random(4, n);
      const ColumnBlock expected = dense(lower).llt().solve(b.transpose()).transpose();
      ColumnBlock z;
      Workers workers;
      factor.solve(b, z, workers);
      EXPECT_LT((z - expected).norm(), 1e-11 * expected.norm()) << n << " " << entries;
      EXPECT_GE(factor.nonzeros(), lower.nonZeros());
    }
  }
}

/// Springs between neighbours on a square of side², numbered by halving it again and again: a
/// factor with branches.
SparseMatrix grid_lower(int side) {
  std::vector<int> number(side * side, -1);
  int next = 0;
  const std::function<void(int, int, int, int)> halve = [&](int x0, int x1, int y0, int y1) {
    if (x0 >= x1 || y0 >= y1) return;
    const bool across = x1 - x0 > y1 - y0;
    const int middle = across ? (x0 + x1) / 2 : (y0 + y1) / 2;
    halve(x0, across ? middle : x1, y0, across ? y1 : middle);
    halve(across ? middle + 1 : x0, x1, across ? y0 : middle + 1, y1);
    for (int x = across ? middle : x0; x < (across ? middle + 1 : x1); ++x) {
      for (int y = across ? y0 : middle; y < (across ? y1 : middle + 1); ++y) {
        number[y * side + x] = next++;
      }
    }
  };
  halve(0, side, 0, side);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int i = 0; i < side * side; ++i) {
    triplets.emplace_back(number[i], number[i], 4.1);
    for (const int j : {i + 1, i + side}) {
      if (j >= side * side || (j == i + 1 && j % side == 0)) continue;
      const int a = number[i], b = number[j];
      triplets.emplace_back(std::max(a, b), std::min(a, b), -1);
    }
  }
  SparseMatrix lower(side * side, side * side);
  lower.setFromTriplets(triplets.begin(), triplets.end());
  return lower;
}

TEST(ColumnCholesky, SolvesBranchByBranchToTheSameBytesOnAnyNumberOfThreads) {
  const SparseMatrix lower = grid_lower(150);
  ColumnCholesky factor;
  ASSERT_TRUE(factor.factorize(lower));
  ASSERT_GT(factor.nonzeros(), 400000);  // enough to be shared out
  const ColumnBlock b = ColumnBlock::Random(4, lower.cols());
  ColumnBlock one, two, three, product = ColumnBlock::Zero(4, lower.cols());
  Workers first(1), second(2), third(3);
  factor.solve(b, one, first);
  factor.solve(b, two, second);
  factor.solve(b, three, third);
  EXPECT_TRUE(one == two);
  EXPECT_TRUE(one == three);
  add_product(lower, one, product);
  EXPECT_LT((product - b).norm(), 1e-12 * b.norm());
}

TEST(FactorBranches, AreDisjointSubtreesOfAboutEqualWorkBelowTheTop) {
  constexpr int kLeaves = 256;  // of a binary tree in postorder
  std::vector<int> parent;
  const std::function<int(int)> grow = [&](int leaves) {
    std::vector<int> children;
    if (leaves > 1) children = {grow(leaves / 2), grow(leaves / 2)};
    const auto root = static_cast<int>(parent.size());
    parent.push_back(-1);
    for (const int child : children) parent[child] = root;
    return root;
  };
  grow(kLeaves);
  const auto n = static_cast<int>(parent.size());
  EXPECT_TRUE(find_branches(parent, std::vector<std::size_t>(n, 1)).branches.empty());
  const FactorBranches found = find_branches(parent, std::vector<std::size_t>(n, 10000));
  std::vector<int> branch_of(n, -1), size;
  for (const auto& branch : found.branches) {
    size.push_back(0);
    for (const auto [begin, end] : branch) {
      for (int i = begin; i < end; ++i) {
        EXPECT_EQ(branch_of[i], -1);
        branch_of[i] = static_cast<int>(size.size()) - 1;
        ++size.back();
      }
    }
  }
  for (const auto [begin, end] : found.top) {
    for (int i = begin; i < end; ++i) EXPECT_EQ(branch_of[i], -1);
  }
  for (int i = 0; i + 1 < n; ++i) {
    if (branch_of[parent[i]] >= 0) {
      EXPECT_EQ(branch_of[i], branch_of[parent[i]]);
    }
  }
  ASSERT_FALSE(size.empty());
  EXPECT_GT(std::ranges::min(size), n / 5);
  EXPECT_LT(std::ranges::max(size), n / 3);
}

TEST(ColumnCholesky, RefusesWhatIsSingularOrIndefinite) {
  SparseMatrix lower = random_lower(20, 60, 1);
  ColumnCholesky factor;
  EXPECT_TRUE(factor.factorize(lower));
  lower.coeffRef(7, 7) = -1;
  EXPECT_FALSE(factor.factorize(lower));
  SparseMatrix chain(3, 3);  // of springs that nothing holds
  chain.insert(0, 0) = 1, chain.insert(1, 0) = -1, chain.insert(1, 1) = 2;
  chain.insert(2, 1) = -1, chain.insert(2, 2) = 1;
  chain.makeCompressed();
  EXPECT_FALSE(factor.factorize(chain));
}

TEST(ColumnBlock, ProductIsThatOfTheWholeMatrix) {
  const SparseMatrix lower = random_lower(60, 300, 3);
  const ColumnBlock x = ColumnBlock::Random(4, 60);
  ColumnBlock y = ColumnBlock::Random(4, 60);
  const ColumnBlock expected = y + x * dense(lower);
  add_product(lower, x, y);
  EXPECT_LT((y - expected).norm(), 1e-13 * expected.norm());
  EXPECT_NEAR(dot(x, y), x.cwiseProduct(y).sum(), 1e-12);
}

}  // namespace
}  // namespace deformlab::test
