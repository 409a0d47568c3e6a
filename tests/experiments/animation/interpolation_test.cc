#include "experiments/subjects/motion/interpolation.h"

#include <gtest/gtest.h>

namespace deformlab::test {
namespace {

std::vector<PoseNumbers> numbers(const std::vector<double>& values) {
  std::vector<PoseNumbers> result;
  for (const double value : values) result.push_back(PoseNumbers::Constant(value));
  return result;
}

const std::vector<FrameTime> kTimes{0, 4, 5, 12, 20};
const std::vector<double> kValues{1, 3, 3, 9, -2};

double at(FrameTime moment, Interpolation kind) {
  return interpolated(kTimes, numbers(kValues), moment, kind)[0];
}

TEST(Interpolation, MeetsEachKeyAndStaysBeyondTheEnds) {
  for (const auto& [kind, name] : names_of(Interpolation())) {
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
      EXPECT_EQ(at(kTimes[i], kind), kValues[i]) << name;
    }
    EXPECT_EQ(at(-3, kind), 1) << name;
    EXPECT_EQ(at(99, kind), -2) << name;
  }
}

TEST(Interpolation, ASplineNeverOvershoots) {
  for (std::size_t i = 0; i + 1 < kTimes.size(); ++i) {
    double before = kValues[i];
    const double sign = kValues[i + 1] - kValues[i];
    for (int step = 1; step <= 50; ++step) {
      const FrameTime moment = kTimes[i] + (kTimes[i + 1] - kTimes[i]) * step / 50;
      const double value = at(moment, Interpolation::kSpline);
      EXPECT_GE((value - before) * sign, -1e-12) << i << " " << step;
      EXPECT_TRUE(sign != 0 || value == before) << i << " " << step;
      before = value;
    }
  }
}

TEST(Interpolation, TheSpeedOfASplineHasNoJumps) {
  const auto speed = [](FrameTime from, FrameTime to) {
    return (at(to, Interpolation::kSpline) - at(from, Interpolation::kSpline)) /
           static_cast<double>(to - from);
  };
  constexpr FrameTime kStep = 1e-5L;
  for (std::size_t i = 1; i + 1 < kTimes.size(); ++i) {
    EXPECT_NEAR(speed(kTimes[i] - kStep, kTimes[i]), speed(kTimes[i], kTimes[i] + kStep), 1e-3);
  }
  const double linear_jump = at(12.001L, Interpolation::kLinear) -
                             2 * at(12, Interpolation::kLinear) +
                             at(11.999L, Interpolation::kLinear);
  EXPECT_GT(std::abs(linear_jump), 1e-3) << "the same keys have a corner without a spline";
}

TEST(Interpolation, ASplineOfProportionalKeysIsALine) {
  const std::vector<FrameTime> times{0, 1, 5, 6};
  for (const double moment : {0.5, 2.25, 5.5}) {
    const double value =
        interpolated(times, numbers({0, 1, 5, 6}), moment, Interpolation::kSpline)[0];
    EXPECT_NEAR(value, moment, 1e-12);
  }
}

TEST(Interpolation, ASplineOfTwoKeysIsALine) {
  EXPECT_NEAR(interpolated({0, 4}, numbers({1, 3}), 1, Interpolation::kSpline)[0], 1.5, 1e-15);
}

TEST(Interpolation, KeysMayLieBetweenFrames) {
  EXPECT_NEAR(interpolated({0.5L, 2.5L}, numbers({0, 1}), 1, Interpolation::kLinear)[0], 0.25,
              1e-15);
}

}  // namespace
}  // namespace deformlab::test
