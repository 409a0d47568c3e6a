// Extracted from CONTRIBUTING.md when the tests are configured.
#include "energies/volume.h"
#include "tests/energies/laws_suite.h"

namespace deformlab::test {
namespace {

template <class List, class Term>
struct With;
template <class... All, class Term>
struct With<TermList<All...>, Term> {
  using List = TermList<All..., Term>;
};

template <int d>
using AllAndVolume = typename MembersOf<typename With<GraphTerms<d>, Volume<d>>::List>::Types;
INSTANTIATE_TYPED_TEST_SUITE_P(InSpaceWithVolume, Laws, AllAndVolume<3>, TermNames);
INSTANTIATE_TYPED_TEST_SUITE_P(InThePlaneWithVolume, Laws, AllAndVolume<2>, TermNames);

TEST(VolumeTerm, SeesAReflectionThatRotationDoesNot) {
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, 1, -1).asDiagonal();
  EXPECT_EQ(Rotation<>{}(mirror).norm(), 0);
  EXPECT_EQ(Volume<>{}(mirror)[0], -2);
}

}  // namespace
}  // namespace deformlab::test
