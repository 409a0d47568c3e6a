#include "solvers/linear/panel_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <complex>
#include <random>

namespace deformlab::test {
namespace {

using Complex = std::complex<double>;

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
