#include "geometry/plane/region.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/errors.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Eigen::Matrix2Xd polygon(std::initializer_list<Eigen::Vector2d> corners) {
  Eigen::Matrix2Xd result(2, corners.size());
  Eigen::Index i = 0;
  for (const auto& corner : corners) result.col(i++) = corner;
  return result;
}

Eigen::Matrix2Xd square(double low, double high) {
  return polygon({{low, low}, {high, low}, {high, high}, {low, high}});
}

/// The message of what `checked` throws, empty where it throws nothing.
std::string refused(const Region& region) {
  return test::error_of([&] { checked(region, "it"); });
}

TEST(CheckedRegion, TurnsPolygonsAndDropsRepeatedCorners) {
  Eigen::Matrix2Xd outline =
      polygon({{0, 0}, {0, 9}, {0, 9}, {9, 9}, {9, 9}, {9, 9}, {9, 0}, {0, 0}});
  const Region region = checked({outline, {square(1, 2), square(4, 8)}}, "it");
  EXPECT_EQ(region.outline.cols(), 4);
  EXPECT_EQ(signed_area(region.outline), 81);
  EXPECT_EQ(signed_area(region.holes[0]), -1);
  EXPECT_EQ(signed_area(region.holes[1]), -16);
  EXPECT_EQ(area(region), 64);
  EXPECT_EQ(perimeter(region), 36 + 4 + 16);
}

TEST(CheckedRegion, NamesEdgesThatCross) {
  EXPECT_EQ(
      refused({polygon({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), {}}),
      "cannot use 'it': edge 0 of the outline, (0, 0) to (4, 4), meets edge 2 of the outline, "
      "(4, 0) to (0, 4), at (2, 2); polygons may neither cross nor touch themselves or each "
      "other");
  // A corner on another edge, a corner met twice, an edge that runs back, all corners on a line.
  EXPECT_THAT(refused({polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}), {}}),
              AllOf(HasSubstr("edge 0 of"), HasSubstr("at (2, 0)")));
  EXPECT_THAT(refused({polygon({{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}), {}}),
              HasSubstr("at (2, 2)"));
  EXPECT_THAT(refused({polygon({{0, 0}, {9, 0}, {5, 0}, {5, 5}}), {}}),
              AllOf(HasSubstr("edge 0 of"), HasSubstr("edge 1 of")));
  EXPECT_THAT(refused({polygon({{0, 0}, {1, 1}, {5, 5}}), {}}), HasSubstr("meets"));
}

TEST(CheckedRegion, WantsHolesInsideAndApart) {
  EXPECT_THAT(refused({square(0, 9), {square(1, 2), square(8, 12)}}),
              AllOf(HasSubstr("of the outline"), HasSubstr("of hole 1")));
  EXPECT_THAT(refused({square(0, 9), {square(1, 4), square(3, 6)}}),
              AllOf(HasSubstr("of hole 0"), HasSubstr("of hole 1")));
  EXPECT_THAT(refused({square(0, 9), {square(10, 12)}}), HasSubstr("hole 0 is not inside"));
  EXPECT_THAT(refused({square(4, 5), {square(0, 9)}}), HasSubstr("hole 0 is not inside"));
  EXPECT_THAT(refused({square(0, 9), {square(1, 8), square(3, 6)}}),
              HasSubstr("hole 1 is inside hole 0"));
  EXPECT_THAT(refused({square(0, 9), {square(3, 6), square(1, 8)}}),
              HasSubstr("hole 0 is inside hole 1"));
}

TEST(CheckedRegion, WantsThreeFiniteCornersAndAUsableSize) {
  EXPECT_THAT(refused({}), HasSubstr("the outline has 0 different corners"));
  EXPECT_THAT(refused({polygon({{0, 0}, {1, 1}, {0, 0}}), {}}), HasSubstr("has 2 different"));
  EXPECT_THAT(refused({polygon({{0, 0}, {1, 0}, {NAN, 1}}), {}}), HasSubstr("corner 2 of the out"));
  EXPECT_THAT(refused({square(0, 1), {polygon({{0, 0}, {1, 0}, {1, INFINITY}})}}),
              HasSubstr("corner 2 of hole 0"));
  EXPECT_THAT(refused({1e60 * square(0, 1), {}}), HasSubstr("scale it"));
  EXPECT_THAT(refused({1e-60 * square(0, 1), {}}), HasSubstr("scale it"));
}

TEST(SimplifiedRegion, DropsCornersWithinTheTolerance) {
  Region region;
  region.outline.resize(2, 1000);
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    region.outline.col(i) << 50 * std::cos(angle), 50 * std::sin(angle);
  }
  region.holes.push_back(0.99 * region.outline.rowwise().reverse());  // near it all around
  const Region simple = simplified(region, 0.1);
  EXPECT_LT(simple.outline.cols(), 100);
  EXPECT_NEAR(area(simple) / area(region), 1, 0.2);
  EXPECT_EQ(refused(simple), "");
  const Region coarse = simplified(region, 5);  // ten times the distance between the two
  EXPECT_LT(coarse.outline.cols(), simple.outline.cols());
  EXPECT_EQ(refused(coarse), "");
  for (const auto& corner : coarse.outline.colwise()) {
    EXPECT_EQ((region.outline.colwise() - corner).colwise().norm().minCoeff(), 0);
  }
}

TEST(Region, ContainsWhatIsInTheOutlineAndInNoHole) {
  Region ring{Eigen::Matrix2Xd(2, 4), {Eigen::Matrix2Xd(2, 4)}};
  ring.outline << 0, 9, 9, 0, 0, 0, 9, 9;
  ring.holes[0] << 3, 3, 6, 6, 3, 6, 6, 3;
  EXPECT_TRUE(contains(ring, {1, 5}));
  EXPECT_FALSE(contains(ring, {5, 5}));
  EXPECT_FALSE(contains(ring, {-1, 5}));
  EXPECT_FALSE(contains(ring, {10, 5}));
}

}  // namespace
}  // namespace deformlab::test
