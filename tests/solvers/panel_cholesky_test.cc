#include "solvers/linear/panel_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <complex>
#include <random>

namespace deformlab::test {
namespace {

using Complex = std::complex<double>;

/// The lower triangle of a random positive definite matrix with about this many entries.
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

template <class Scalar>
class PanelCholeskyOf : public ::testing::Test {
 protected:
  using Sparse = Eigen::SparseMatrix<Scalar>;
  using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  Scalar number() {
    if constexpr (std::is_same_v<Scalar, double>) return normal_(random_);
    if constexpr (std::is_same_v<Scalar, Complex>) return {normal_(random_), normal_(random_)};
  }

  /// Lower triangle of a Hermitian matrix of size n with so many entries below the diagonal, whose
  /// eigenvalues are positive.
  Sparse random_matrix(int n, int entries) {
    std::uniform_int_distribution<int> index(0, n - 1);
    std::vector<Eigen::Triplet<Scalar>> triplets;
    Eigen::VectorXd sums = Eigen::VectorXd::Ones(n);
    for (int e = 0; n > 1 && e < entries; ++e) {
      const int i = index(random_), j = index(random_);
      if (i == j) continue;
      const Scalar value = number();
      triplets.emplace_back(std::max(i, j), std::min(i, j), value);
      sums[i] += std::abs(value), sums[j] += std::abs(value);
    }
    for (int i = 0; i < n; ++i) triplets.emplace_back(i, i, Scalar(sums[i]));
    Sparse result(n, n);
    result.setFromTriplets(triplets.begin(), triplets.end());
    return result;
  }

  static Eigen::MatrixXcd dense(const Sparse& lower) {
    const Sparse whole = lower.template selfadjointView<Eigen::Lower>();
    return Dense(whole).template cast<Complex>();
  }

  Eigen::VectorXcd random_vector(int n) {
    Eigen::VectorXcd z(n);
    for (auto& entry : z) entry = {normal_(random_), normal_(random_)};
    return z;
  }

 private:
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

using Scalars = ::testing::Types<double, Complex>;
class ScalarNames {
 public:
  template <class T>
  static std::string GetName(int) {
    return std::is_same_v<T, double> ? "Real" : "Hermitian";
  }
};
TYPED_TEST_SUITE(PanelCholeskyOf, Scalars, ScalarNames);

TYPED_TEST(PanelCholeskyOf, SolvesAsADenseFactorDoes) {
  for (const int n : {1, 2, 3, 4, 5, 9, 40, 120}) {
    for (const int entries : {0, n, 4 * n, n * n}) {
      const auto lower = this->random_matrix(n, entries);
      PanelCholesky<TypeParam> factor;
      ASSERT_TRUE(factor.factorize(lower));
      const Eigen::MatrixXcd A = this->dense(lower);
      Eigen::VectorXcd z = this->random_vector(n);
      const Eigen::VectorXcd expected = A.llt().solve(z);
      factor.solve(z);
      EXPECT_LT((z - expected).norm(), 1e-12 * expected.norm()) << n << " " << entries;
    }
  }
}

TYPED_TEST(PanelCholeskyOf, SolvesForAFewEntriesAsForAll) {
  for (const int n : {1, 3, 9, 40, 200}) {
    for (const int entries : {0, n, 2 * n, n * n}) {
      PanelCholesky<TypeParam> factor;
      ASSERT_TRUE(factor.factorize(this->random_matrix(n, entries)));
      Eigen::VectorXcd zeros = Eigen::VectorXcd::Zero(n);
      for (const int first : {0, n / 2, n - 1}) {
        SparseColumn b(n);
        b.coeffRef(first) = {1, 2};
        b.coeffRef(n / 3) = 3;
        Eigen::VectorXcd whole = b;
        factor.solve_lower(whole);
        EXPECT_EQ(Eigen::VectorXcd(factor.solve_lower(b, zeros)), whole) << n << " " << entries;
        EXPECT_EQ(zeros, Eigen::VectorXcd::Zero(n));
      }
    }
  }
}

TYPED_TEST(PanelCholeskyOf, NoticesWhatIsSingularOrIndefinite) {
  auto lower = this->random_matrix(30, 90);
  PanelCholesky<TypeParam> factor;
  ASSERT_TRUE(factor.factorize(lower));
  lower.coeffRef(7, 7) = -1;
  EXPECT_FALSE(factor.factorize(lower));
  // The Laplacian of a path: constants are its kernel.
  std::vector<Eigen::Triplet<TypeParam>> path;
  for (int i = 0; i + 1 < 20; ++i) {
    path.insert(path.end(), {{i, i, 1.}, {i + 1, i + 1, 1.}, {i + 1, i, -1.}});
  }
  typename TestFixture::Sparse laplacian(20, 20);
  laplacian.setFromTriplets(path.begin(), path.end());
  EXPECT_FALSE(factor.factorize(laplacian));
  laplacian.coeffRef(0, 0) = std::nan("");
  EXPECT_FALSE(factor.factorize(laplacian));
}

TEST(PanelCholesky, SolvesForFourRightHandSidesAsForOne) {
  for (const int n : {1, 2, 3, 4, 5, 9, 40, 150}) {
    for (const int entries : {0, n, 3 * n, n * n}) {
      const SparseMatrix lower = random_lower(n, entries, n + entries);
      PanelCholesky<double> factor;
      ASSERT_TRUE(factor.factorize(lower)) << n << " " << entries;
      const ColumnBlock b = ColumnBlock::Random(4, n);
      const ColumnBlock expected = dense(lower).llt().solve(b.transpose()).transpose();
      ColumnBlock z = b;
      factor.solve(z);
      EXPECT_LT((z - expected).norm(), 1e-11 * expected.norm()) << n << " " << entries;
      EXPECT_GE(factor.nonzeros(), lower.nonZeros());
    }
  }
}

// Springs between neighbours on a square of side², which fill much.
TEST(PanelCholesky, SolvesWithALargeFactor) {
  constexpr int side = 100, n = side * side;
  std::vector<Eigen::Triplet<double>> triplets;
  for (int i = 0; i < n; ++i) {
    triplets.emplace_back(i, i, 4.1);
    if (i % side + 1 < side) triplets.emplace_back(i + 1, i, -1);
    if (i + side < n) triplets.emplace_back(i + side, i, -1);
  }
  SparseMatrix lower(n, n);
  lower.setFromTriplets(triplets.begin(), triplets.end());
  PanelCholesky<double> factor;
  ASSERT_TRUE(factor.factorize(lower));
  ASSERT_GT(factor.nonzeros(), 900000);
  const ColumnBlock b = ColumnBlock::Random(4, n);
  ColumnBlock z = b, product = ColumnBlock::Zero(4, n);
  factor.solve(z);
  add_product(lower, z, product);
  EXPECT_LT((product - b).norm(), 1e-12 * b.norm());
}

TEST(PanelCholesky, RefusesSpringsThatNothingHolds) {
  SparseMatrix chain(3, 3);
  chain.insert(0, 0) = 1, chain.insert(1, 0) = -1, chain.insert(1, 1) = 2;
  chain.insert(2, 1) = -1, chain.insert(2, 2) = 1;
  chain.makeCompressed();
  PanelCholesky<double> factor;
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

TYPED_TEST(PanelCholeskyOf, MayBeFactoredAgain) {
  PanelCholesky<TypeParam> factor;
  for (const int n : {50, 7}) {
    const auto lower = this->random_matrix(n, 3 * n);
    ASSERT_TRUE(factor.factorize(lower));
    const Eigen::VectorXcd expected = this->random_vector(n);
    Eigen::VectorXcd z = this->dense(lower) * expected;
    factor.solve(z);
    EXPECT_LT((z - expected).norm(), 1e-12 * expected.norm());
  }
}

}  // namespace
}  // namespace deformlab::test
