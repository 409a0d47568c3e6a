#include "energies/catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "energies/all.h"
#include "geometry/core/error.h"
#include "tests/support/samples.h"

namespace deformlab {
namespace {

TEST(Catalog, MakesEveryTermThatItNames) {
  const auto sample = test::random_sample(10);
  ASSERT_FALSE(known_energies().empty());
  for (const EnergyInfo& info : known_energies()) {
    const auto energy = make_energy(info.name, sample.context());
    EXPECT_EQ(energy->name(), info.name);
    EXPECT_EQ(energy->structure(), info.structure);
    EXPECT_GE(info.default_weight, 0);
  }
}

TEST(Catalog, WeighsTheTermsOfEmbeddedDeformationAsThePaperDoes) {
  EXPECT_EQ(Rotation<>::kWeight, 1);
  EXPECT_EQ(Regularization<>::kWeight, 10);
  EXPECT_EQ(Constraint<>::kWeight, 100);
}

TEST(Catalog, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const auto sample = test::random_sample(10);
  try {
    make_energy("rotaton", sample.context());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'rotaton'"));
    for (const EnergyInfo& info : known_energies()) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(info.name));
    }
  }
}

// Eq. 5 on paper: columns (1, 0, 0), (1, 2, 0), (0, 0, 3).
TEST(RotationTerm, IsEquation5) {
  Eigen::Matrix3d R;
  R << 1, 1, 0, 0, 2, 0, 0, 0, 3;
  Vector<double, 6> expected;
  expected << 1, 0, 0, 0, 4, 8;
  EXPECT_EQ(Rotation<>{}(R), expected);
}

// Eq. 7: R_j (g_k − g_j) + g_j + t_j − (g_k + t_k).
TEST(RegularizationTerm, IsEquation7) {
  const Eigen::Vector3d g_j(1, 0, 0), g_k(1, 2, 0);
  Affine<double, 3> j{Eigen::Matrix3d::Identity() * 3, {0, 0, 1}}, k{{}, {0.5, 0, 0}};
  const Eigen::Vector3d expected = j.R * (g_k - g_j) + g_j + j.t - (g_k + k.t);
  EXPECT_EQ(Regularization<>{g_k - g_j}(j, k), expected);
}

TEST(ConstraintTerm, MeasuresTheWayToTheTarget) {
  const auto sample = test::random_sample(10);
  const auto energy = make_energy("constraint", sample.context());
  const Eigen::Vector3d way(1, -2, 0.5);
  energy->set_targets(sample.handles.v.colwise() + way);
  Eigen::Matrix3Xd r(3, energy->size());
  energy->residuals(sample.rest(), r.data());
  EXPECT_EQ(energy->size(), sample.handles.v.cols());
  EXPECT_LT((r.colwise() + way).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace deformlab
