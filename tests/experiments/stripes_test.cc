#include "experiments/measure/stripes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr int kColumns = 101, kRows = 30;

double stripes_of(const std::function<double(double, double)>& height) {
  Eigen::Matrix3Xd V(3, kColumns * kRows);
  for (int v = 0; v < V.cols(); ++v) {
    const int column = v % kColumns, row = v / kColumns;
    const double x = column / 100.0, y = row / 29.0;
    V.col(v) << x, y, height(x, y);
  }
  return stripes(V, kColumns, 11).at("stripes");
}

TEST(Stripes, ABentPlaneHasNextToNone) {
  EXPECT_LT(stripes_of([](double, double) { return 0.0; }), 1e-12);
  EXPECT_LT(stripes_of([](double x, double) { return 0.3 * x * x; }), 0.05);
}

TEST(Stripes, WavesAcrossThePlaneAreSeenInDegrees) {
  // z = a sin(kx) has the slope a k cos(kx), whose root mean square is a k / √2.
  const double k = 2 * std::numbers::pi * 10, a = 0.001;
  const double expected = a * k / std::sqrt(2.0) * 180 / std::numbers::pi;
  EXPECT_NEAR(stripes_of([&](double x, double) { return a * std::sin(k * x); }), expected,
              0.1 * expected);
}

TEST(Stripes, BumpsThatDifferFromRowToRowCountLittle) {
  const double k = 2 * std::numbers::pi * 10, a = 0.001;
  const double waves = stripes_of([&](double x, double) { return a * std::sin(k * x); });
  const auto bumps = [&](double x, double y) { return a * std::sin(k * (x + y * 29 / 30)); };
  EXPECT_LT(stripes_of(bumps), 0.05 * waves);
}

TEST(Stripes, RefusesAWindowOutOfRange) {
  const Eigen::Matrix3Xd V = Eigen::Matrix3Xd::Zero(3, 30);
  for (const int window : {-1, 2, 4, 11}) EXPECT_THROW(stripes(V, 10, window), InputError);
}

}  // namespace
}  // namespace deformlab
