// The term and the list of terms are made from CONTRIBUTING.md when the tests are configured, so
// that the law tests and the catalog of this program have the term too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "energies/all.h"
#include "energies/catalog.h"
#include "tests/support/samples.h"

namespace deformlab::test {
namespace {

TEST(VolumeTerm, IsInTheCatalogAfterAllOthers) {
  std::vector<std::string> names;
  for (const EnergyInfo& info : known_energies()) names.push_back(info.name);
  names.resize(6);  // without terms that other tests register
  EXPECT_THAT(names, ::testing::ElementsAre("rotation", "regularization", "constraint",
                                            "smoothness", "orientation", "volume"));
  EXPECT_EQ(energy_info("volume").default_weight, 0);
  EXPECT_EQ(energy_info("volume").structure, Structure::kNonlinear);
  EXPECT_FALSE(energy_info("volume").for_rigid_nodes);
}

TEST(VolumeTerm, IsMadeInSpaceAndInThePlane) {
  const Sample sample = random_sample(10);
  for (const int d : {2, 3}) {
    const auto energy = make_energy("volume", sample.context(d));
    EXPECT_EQ(energy->dimension(), d);
    EXPECT_EQ(energy->size(), sample.nodes());
  }
}

TEST(VolumeTerm, SeesAReflectionThatRotationDoesNot) {
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  EXPECT_EQ(Rotation<>{}(mirror).norm(), 0);
  EXPECT_EQ(Volume<>{}(mirror)[0], -2);
}

}  // namespace
}  // namespace deformlab::test
