#include "experiments/scenes/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/measure/measurements.h"
#include "experiments/scenes/resample.h"
#include "geometry/core/error.h"
#include "tests/support/shapes.h"

namespace deformlab {
namespace {

Shape small_plane() {
  ShapeOptions options;
  options.columns = options.rows = 21;
  options.bumps = 2;
  options.bump_height = 0.1;
  return make_plane(options);
}

TEST(Resampled, MeetsTheNumberFromAboveAndFromBelow) {
  for (const int vertices : {200, 441, 1500, 3000}) {
    const Shape shape = resampled(small_plane(), vertices);
    EXPECT_NEAR(shape.V.cols(), vertices, 0.01 * vertices);
    EXPECT_NO_THROW(check(shape, "it"));
    EXPECT_NEAR(shape.V.row(0).maxCoeff(), 1, 0.05);
  }
}

TEST(Resampled, RefusesWhatIsNoMesh) {
  EXPECT_THROW(resampled(test::point_set(50), 100), InputError);
  EXPECT_THROW(resampled(small_plane(), 3), InputError);
}

TEST(RangeScan, GivesUnmergedImagesWithHolesAndOutliers) {
  RangeScanOptions options;
  options.views = 4;
  options.resolution = 48;
  const Shape scan = range_scan(test::tube(12), options);
  EXPECT_NO_THROW(check(scan, "it"));
  options.outliers = options.holes = 0;
  const Shape clean = range_scan(test::tube(12), options);
  EXPECT_GT(clean.V.cols(), 1000);
  EXPECT_GT(scan.faces.size(), 40u);
  EXPECT_LT(scan.faces.size(), clean.faces.size() + 4 * 12);  // holes took some
}

TEST(RangeScan, LiesOnTheSurface) {
  RangeScanOptions options;
  options.views = 6;
  options.resolution = 64;
  options.noise = options.outliers = options.holes = 0;
  const Shape scan = range_scan(test::tube(12), options);
  for (const auto v : scan.V.colwise()) {
    const double radius = std::hypot(v.y(), v.z());
    EXPECT_GT(radius, std::cos(std::numbers::pi / 12) - 1e-5);
    EXPECT_LT(radius, 1 + 1e-5);
  }
}

TEST(RangeScan, IsTheSameEachTimeAndNamesWhatItCannotDo) {
  RangeScanOptions options;
  options.views = 2;
  options.resolution = 32;
  EXPECT_EQ(range_scan(small_plane(), options).V, range_scan(small_plane(), options).V);
  options.resolution = 4;
  EXPECT_THROW(range_scan(small_plane(), options), InputError);
  options.resolution = 32;
  EXPECT_THROW(range_scan(test::point_set(50), options), InputError);
}

TEST(CountComponents, AreWhatNoFaceJoins) {
  EXPECT_EQ(count_components(small_plane()), 1);
  EXPECT_EQ(count_components(test::side_by_side(test::tube(4), test::tube(3), {9, 0, 0})), 2);
  EXPECT_EQ(count_components(test::point_set(50)), 50);
}

}  // namespace
}  // namespace deformlab
