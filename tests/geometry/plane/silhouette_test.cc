#include "geometry/plane/silhouette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "geometry/core/error.h"
#include "geometry/plane/marching_squares.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

Silhouette traced(const Eigen::ArrayXXf& alpha, const TraceOptions& options = {}) {
  return trace(alpha, options, "a picture");
}

/// Each pixel's share that `inside` covers, from 16×16 places in it.
Eigen::ArrayXXf covered(int height, int width, const std::function<bool(double, double)>& inside) {
  constexpr int kFine = 16;
  Eigen::ArrayXXf alpha = Eigen::ArrayXXf::Zero(height, width);
  for (int y = 0; y < height * kFine; ++y) {
    for (int x = 0; x < width * kFine; ++x) {
      alpha(y / kFine, x / kFine) += inside((x + 0.5) / kFine, (y + 0.5) / kFine);
    }
  }
  return alpha / (kFine * kFine);
}

Eigen::ArrayXXf disc(int size, double radius) {
  return covered(size, size, [=](double x, double y) {
    return std::hypot(x - size / 2.0, y - size / 2.0) < radius;
  });
}

Eigen::ArrayXXf noise(int height, int width, unsigned seed) {
  std::mt19937 random(seed);
  return Eigen::ArrayXXf::NullaryExpr(height, width, [&] { return (random() % 5) / 4.0f; });
}

TEST(Trace, MeasuresADiscBelowAPixel) {
  const Silhouette found = traced(disc(100, 40.3));
  const double exact = std::numbers::pi * 40.3 * 40.3;
  EXPECT_NEAR(area(found.region) / exact, 1, 1e-3);
  for (const auto& corner : found.region.outline.colwise()) {
    // A tenth of a pixel: what a slanted edge covers of a pixel is not linear in its distance.
    EXPECT_NEAR((corner - Eigen::Vector2d(50, 50)).norm(), 40.3, 0.1);
  }
  EXPECT_EQ(found.region.holes.size(), 0u);
  EXPECT_EQ(found.detached.size(), 0u);
  EXPECT_EQ(found.detached_share, 0);
}

TEST(Trace, KeepsHolesUnlessToldOtherwise) {
  const Eigen::ArrayXXf ring = disc(100, 40) - disc(100, 20);
  const Silhouette kept = traced(ring);
  ASSERT_EQ(kept.region.holes.size(), 1u);
  EXPECT_NEAR(area(kept.region) / (std::numbers::pi * 1200), 1, 1e-3);
  EXPECT_GT(signed_area(kept.region.outline), 0);
  EXPECT_LT(signed_area(kept.region.holes[0]), 0);
  EXPECT_EQ(kept.filled_holes, 0);

  const Silhouette filled = traced(ring, {.fill_holes = true});
  EXPECT_NEAR(area(filled.region) / (std::numbers::pi * 1600), 1, 1e-3);
  EXPECT_EQ(filled.filled_holes, 1);
  EXPECT_EQ(traced(ring, {.least_hole = 1300}).filled_holes, 1);
  EXPECT_EQ(traced(ring, {.least_hole = 1200}).filled_holes, 0);
}

TEST(Trace, KeepsTheLargestPartAndCountsTheOthers) {
  // A disc inside a wide but thin frame, and a small disc beside: the frame has the least area.
  const Eigen::ArrayXXf alpha = covered(120, 160, [](double x, double y) {
    const bool frame = (x < 3 || x > 117 || y < 3 || y > 117) && x < 120;
    return frame || std::hypot(x - 60, y - 60) < 30 || std::hypot(x - 140, y - 60) < 10;
  });
  const Silhouette found = traced(alpha);
  const double large = std::numbers::pi * 900, others = std::numbers::pi * 100 + 120 * 12 - 36;
  EXPECT_NEAR(area(found.region) / large, 1, 1e-3);
  EXPECT_EQ(found.region.holes.size(), 0u);
  EXPECT_EQ(found.detached.size(), 2u);
  EXPECT_NEAR(found.detached_share, others / (large + others), 1e-3);
}

TEST(Trace, AttachesHolesToThePartAroundThem) {
  // Two rings beside each other, and a ring within the hole of the right one.
  const Eigen::ArrayXXf alpha = covered(100, 200, [](double x, double y) {
    const double left = std::hypot(x - 50, y - 50), right = std::hypot(x - 150, y - 50);
    return (left < 45 && left > 20) || (right < 49 && right > 35) || (right < 25 && right > 15);
  });
  const std::vector<Region> parts = level_set(alpha, 0.5f);
  ASSERT_EQ(parts.size(), 3u);
  for (const Region& part : parts) {
    ASSERT_EQ(part.holes.size(), 1u);
    EXPECT_NO_THROW(checked(part, "a part"));  // the hole is inside its outline
  }
  EXPECT_NEAR(area(traced(alpha).region) / (std::numbers::pi * (45 * 45 - 400)), 1, 2e-3);
}

TEST(Trace, EndsAtTheBorderOfTheImage) {
  const Silhouette full = traced(Eigen::ArrayXXf::Ones(7, 5));
  Eigen::Matrix2Xd corners(2, 4);
  corners << 0, 5, 5, 0, 0, 0, 7, 7;
  ASSERT_EQ(full.region.outline.cols(), 4);
  EXPECT_EQ(area(full.region), 35);
  for (const auto& corner : corners.colwise()) {
    EXPECT_EQ((full.region.outline.colwise() - corner).colwise().norm().minCoeff(), 0);
  }
  EXPECT_EQ(area(traced(Eigen::ArrayXXf::Constant(7, 5, 0.6f)).region), 35);
  EXPECT_EQ(area(traced(Eigen::ArrayXXf::Ones(1, 1)).region), 1);

  Eigen::ArrayXXf half = Eigen::ArrayXXf::Zero(10, 10);
  half.leftCols(4) = 1;
  EXPECT_NEAR(area(traced(half).region), 40, 1e-12);
}

TEST(Trace, GivesOnePixelAsADiamond) {
  Eigen::ArrayXXf alpha = Eigen::ArrayXXf::Zero(5, 5);
  alpha(3, 1) = 1;
  const Silhouette found = traced(alpha);
  EXPECT_EQ(found.region.outline.cols(), 4);
  EXPECT_NEAR(area(found.region), 0.5, 1e-12);
  EXPECT_EQ(found.region.outline.rowwise().mean(), Eigen::Vector2d(1.5, 3.5));
}

TEST(Trace, PlacesTheBoundaryWhereTheThresholdIsMet) {
  Eigen::ArrayXXf ramp(3, 11);
  for (int x = 0; x < 11; ++x) ramp.col(x) = static_cast<float>(x) / 10;
  for (const double threshold : {0.13, 0.52, 0.77}) {
    const Region region = traced(ramp, {.threshold = threshold}).region;
    EXPECT_NEAR(region.outline.row(0).minCoeff(), 0.5 + 10 * threshold, 1e-6);
    EXPECT_EQ(region.outline.row(0).maxCoeff(), 11);
  }
}

TEST(Trace, ConnectsAcrossACornerWhereTheSurfaceDoes) {
  Eigen::ArrayXXf alpha = Eigen::ArrayXXf::Zero(4, 4);
  alpha(1, 1) = alpha(2, 2) = 1;
  EXPECT_EQ(traced(alpha).detached.size(), 0u);
  alpha(1, 1) = alpha(2, 2) = 0.9f;  // 0.45 in the middle
  EXPECT_EQ(traced(alpha).detached.size(), 1u);
  alpha(1, 2) = alpha(2, 1) = 0.2f;  // 0.9² > 0.5 … and 0.5375 there
  EXPECT_EQ(traced(alpha).detached.size(), 0u);
}

TEST(Trace, GivesSimplePolygonsOfNoise) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Eigen::ArrayXXf alpha = noise(17, 23, seed);
    double sum = 0;
    for (const Region& part : level_set(alpha, 0.5f)) {
      EXPECT_NO_THROW(checked(part, "noise")) << seed;
      sum += area(part);
    }
    const Silhouette found = traced(alpha, {.least_hole = 0});
    EXPECT_NEAR(found.detached_share, 1 - area(found.region) / sum, 1e-12);
  }
}

TEST(Trace, TurnedImagesGiveTurnedShapes) {
  const Eigen::ArrayXXf alpha = noise(12, 19, 5);
  const Silhouette one = traced(alpha), turned = traced(alpha.transpose());
  EXPECT_NEAR(area(one.region), area(turned.region), 1e-9);
  EXPECT_NEAR(perimeter(one.region), perimeter(turned.region), 1e-9);
  EXPECT_EQ(one.detached.size(), turned.detached.size());
}

TEST(Trace, TakesAVeryWideImage) {
  Eigen::ArrayXXf alpha = Eigen::ArrayXXf::Zero(50, 20000);
  alpha.block(10, 5, 30, 19990) = 1;
  EXPECT_NEAR(area(traced(alpha).region), 30 * 19990 - 0.5, 1e-6);  // its corners are cut
}

TEST(Trace, SaysWhyAnImageCannotBeTraced) {
  const auto refused = [](const Eigen::ArrayXXf& alpha, const TraceOptions& options) {
    try {
      traced(alpha, options);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Eigen::ArrayXXf alpha = Eigen::ArrayXXf::Constant(3, 3, 0.25f);
  EXPECT_EQ(refused(alpha, {}),
            "cannot trace 'a picture': it has no opaque pixel: the greatest opacity is 0.25, but "
            "the shape begins at 0.5 (threshold)");
  EXPECT_THAT(refused(Eigen::ArrayXXf(0, 0), {}), HasSubstr("it has no pixels"));
  EXPECT_THAT(refused(alpha, {.threshold = 0}), HasSubstr("threshold is 0;"));
  EXPECT_THAT(refused(alpha, {.threshold = NAN}), HasSubstr("threshold is nan;"));
  EXPECT_THAT(refused(alpha, {.least_hole = -1}), HasSubstr("least_hole is -1;"));
  alpha(1, 2) = NAN;
  EXPECT_THAT(refused(alpha, {}), HasSubstr("not finite"));
}

}  // namespace
}  // namespace deformlab::test
