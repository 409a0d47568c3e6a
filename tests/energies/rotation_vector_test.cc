#include <gtest/gtest.h>

#include "energies/all.h"
#include "tests/energies/laws.h"

namespace deformlab::test {
namespace {

TEST(RotationVector, IsTheRotationByItsLength) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized(), v(0.3, 2, -1);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.0099, 0.0101, 1.0, 3.1, 6.2, 20.0}) {
    const Eigen::Vector3d expected = Eigen::AngleAxisd(angle, axis) * v;
    EXPECT_LT((rotated<double>(angle * axis, v) - expected).norm(), 1e-14 * (1 + angle)) << angle;
  }
}

TEST(RotationVector, DerivativesAgreeOnBothSidesOfTheSeries) {
  const Sample sample = random_sample(9, 2, 7);
  for (const double scale : {1e-9, 1e-3, 0.005, 0.02}) {
    const Unknowns x = perturbed(sample.rest<RigidNode>(), scale, 4);
    EXPECT_TRUE(derivatives_agree(sum_over<Regularization<RigidNode>>(sample), x)) << scale;
    EXPECT_TRUE(derivatives_agree(sum_over<Constraint<RigidNode>>(sample), x)) << scale;
    EXPECT_TRUE(derivatives_agree(sum_over<Smoothness<RigidNode>>(sample), x)) << scale;
  }
}

// The affine state of the same rotations and translations.
Unknowns affine(const Unknowns& rigid) {
  Unknowns x = Unknowns::uniform(Eigen::MatrixXd::Zero(3, 4 * rigid.nodes()), rigid.nodes());
  for (int j = 0; j < rigid.nodes(); ++j) {
    const Eigen::Vector3d omega = rigid.X.col(2 * j);
    x.X.middleCols<3>(4 * j) = Eigen::AngleAxisd(omega.norm(), omega.normalized()).matrix();
    x.X.col(4 * j + 3) = rigid.X.col(2 * j + 1);
  }
  return x;
}

template <template <class> class Term>
void expect_same(const Sample& sample) {
  const Unknowns x = perturbed(sample.rest<RigidNode>(), 1, 5);
  const TermEnergy<Term<RigidNode>> rigid(sum_over<Term<RigidNode>>(sample));
  const TermEnergy<Term<AffineNode<3>>> other(sum_over<Term<AffineNode<3>>>(sample));
  EXPECT_LT(relative_difference(residuals(rigid, x), residuals(other, affine(x))), 1e-13);
}

TEST(RotationVector, ItsTermsAreTheAffineOnesAtRotations) {
  const Sample sample = random_sample(12, 4, 1);
  expect_same<Regularization>(sample);
  expect_same<Constraint>(sample);
  expect_same<Smoothness>(sample);
}

}  // namespace
}  // namespace deformlab::test
