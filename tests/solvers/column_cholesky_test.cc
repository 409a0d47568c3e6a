#include "solvers/column_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
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
      Columns4 z = Columns4::Random(4, n);
      const Columns4 expected = dense(lower).llt().solve(z.transpose()).transpose();
      factor.solve(z);
      EXPECT_LT((z - expected).norm(), 1e-11 * expected.norm()) << n << " " << entries;
      EXPECT_GE(factor.nonzeros(), lower.nonZeros());
    }
  }
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

TEST(Columns4, ProductIsThatOfTheWholeMatrix) {
  const SparseMatrix lower = random_lower(60, 300, 3);
  const Columns4 x = Columns4::Random(4, 60);
  Columns4 y = Columns4::Random(4, 60);
  const Columns4 expected = y + x * dense(lower);
  add_product(lower, x, y);
  EXPECT_LT((y - expected).norm(), 1e-13 * expected.norm());
  EXPECT_NEAR(dot(x, y), x.cwiseProduct(y).sum(), 1e-12);
}

}  // namespace
}  // namespace deformlab::test
