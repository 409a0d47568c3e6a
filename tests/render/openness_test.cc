#include "render/openness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/render.h"

namespace deformlab {
namespace {

constexpr int kWidth = 160, kHeight = 120;

// A floor, and a wall that stands on its middle.
Shape corner() {
  Shape shape;
  shape.V.resize(3, 8);
  shape.V.leftCols(4) << -1, 1, 1, -1, -1, -1, 1, 1, 0, 0, 0, 0;
  shape.V.rightCols(4) << -1, 1, 1, -1, 0, 0, 0, 0, 0, 0, 1, 1;
  shape.faces = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  return shape;
}

struct Seen {
  View view = frame(corner().V, {.direction = {0, 1, -0.7}}, kWidth, kHeight);
  Shape shape = corner();
  Surface surface{&shape, Eigen::Matrix3Xd(3, 0), view};
  Eigen::Vector3f eye = view.eye.cast<float>();

  std::optional<SurfacePoint> at(double x, double y) const {
    const Eigen::Vector3f ray = view.ray(x / kWidth, y / kHeight);
    const auto hit = surface.scene().first_hit(eye, ray);
    if (!hit) return std::nullopt;
    return surface.at(*hit, eye, ray);
  }
};

TEST(Openness, IsWholeOnAFreeFaceAndHalfInACorner) {
  const Seen seen;
  SurfacePoint point{
      seen.view.framed(Eigen::Vector3d(0, -0.9, 0)).cast<float>(), {0, 0, 1}, {0, 0, 1}, {1, 1, 1}};
  EXPECT_GT(seen.surface.openness(point), 0.9);
  point.place = seen.view.framed(Eigen::Vector3d(0, -0.005, 0)).cast<float>();
  EXPECT_NEAR(seen.surface.openness(point), 0.5, 0.1);
}

TEST(Openness, InterpolatedIsNearToMeasured) {
  const Seen seen;
  const OpennessLattice lattice(seen.surface, seen.view, kWidth, kHeight, 1);
  int count = 0;
  double sum = 0;
  for (double y = 0.3; y < kHeight; y += 2.7) {
    for (double x = 0.4; x < kWidth; x += 3.1) {
      const auto point = seen.at(x, y);
      if (!point) continue;
      ++count;
      const double off = std::abs(lattice.at(x, y, *point) - seen.surface.openness(*point));
      EXPECT_LT(off, 0.2) << x << ' ' << y;  // in the corner it falls by a half within a pixel
      sum += off;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_LT(sum / count, 0.01);
}

TEST(Openness, DoesNotDependOnThreads) {
  const Seen seen;
  const OpennessLattice one(seen.surface, seen.view, kWidth, kHeight, 1);
  const OpennessLattice four(seen.surface, seen.view, kWidth, kHeight, 4);
  const auto point = seen.at(80, 60);
  ASSERT_TRUE(point);
  EXPECT_EQ(one.at(80, 60, *point), four.at(80, 60, *point));
}

// One ray for each pixel finds the edges, and further rays smooth them.
TEST(Render, EdgesAreSmoothAndFlatPartsAreNot) {
  const Shape shape = corner();
  const auto picture = [&](int samples) {
    const RenderOptions options{.width = kWidth, .height = kHeight, .samples = samples};
    return render({.shape = &shape}, frame(shape.V, options.camera, kWidth, kHeight), options);
  };
  const Image rough = picture(1), smooth = picture(3);
  int changed = 0;
  for (std::size_t i = 0; i < rough.rgb.size(); ++i) changed += rough.rgb[i] != smooth.rgb[i];
  EXPECT_GT(changed, 200);
  EXPECT_LT(changed, kWidth * kHeight);  // a third of the bytes
}

}  // namespace
}  // namespace deformlab
