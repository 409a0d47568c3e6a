#include "experiments/subjects/motion/spatial_keys.h"

#include <gtest/gtest.h>

#include <numbers>

namespace deformlab::test {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Matrix2Xd points(int n) {
  Eigen::Matrix2Xd all(2, 6);
  all << 100, 300, 200, 40, 310, 205, 300, 310, 150, 60, 20, 154;
  return all.leftCols(n);
}

TEST(SpatialKeys, MeetEachPoseAtItsPoint) {
  for (const int n : {2, 3, 4, 6}) {
    const SpatialKeys keys(points(n));
    for (int i = 0; i < n; ++i) {
      const Eigen::VectorXd weights = keys.weights(points(n).col(i));
      EXPECT_LT((weights - Eigen::VectorXd::Unit(n, i)).norm(), 1e-12) << n << " " << i;
    }
  }
}

TEST(SpatialKeys, ReproduceWhatIsAffine) {
  const SpatialKeys keys(points(6));
  for (const auto& [x, y] : {std::pair(0., 0.), {150., 222.}, {900., -70.}}) {
    const Eigen::VectorXd weights = keys.weights({x, y});
    EXPECT_NEAR(weights.sum(), 1, 1e-12);
    EXPECT_LT((points(6) * weights - Eigen::Vector2d(x, y)).norm(), 1e-9);
  }
}

TEST(SpatialKeys, OfALineOnlyVaryAlongIt) {
  Eigen::Matrix2Xd line(2, 3);
  line << 0, 10, 30, 0, 5, 15;
  const SpatialKeys keys(line);
  EXPECT_TRUE(keys.weights({20, 10}).allFinite());
  const Eigen::VectorXd middle = SpatialKeys(line.leftCols(2)).weights({5, 2.5});
  EXPECT_LT((middle - Eigen::Vector2d(0.5, 0.5)).norm(), 1e-12);
}

TEST(SpatialKeys, ScaleAndPlaceChangeNothing) {
  const Eigen::VectorXd here = SpatialKeys(points(4)).weights({170, 200});
  const Eigen::Vector2d away(1e5, -3e4);
  const Eigen::Matrix2Xd there = 1e3 * points(4);
  const SpatialKeys keys(there.colwise() + away);
  EXPECT_LT((keys.weights(1e3 * Eigen::Vector2d(170, 200) + away) - here).norm(), 1e-9);
}

double angle_between(double first, double second, double weight) {
  std::vector<PoseNumbers> poses(2, PoseNumbers::Zero());
  poses[0][kTurnOfNumbers + 2] = first;
  poses[1][kTurnOfNumbers + 2] = second;
  return blended(poses, Eigen::Vector2d(1 - weight, weight))[kTurnOfNumbers + 2];
}

TEST(SpatialKeys, BlendAnglesAsRotations) {
  EXPECT_NEAR(angle_between(0.2, 0.6, 0.5), 0.4, 1e-12);
  EXPECT_NEAR(std::abs(angle_between(kPi - 0.1, -kPi + 0.1, 0.5)), kPi, 1e-12)
      << "the short way round";
  EXPECT_NEAR(angle_between(0, kPi, 0.4), 0, 1e-12);
  EXPECT_NEAR(angle_between(0, kPi, 0.5), 0, 1e-12) << "neither direction is between them";
}

}  // namespace
}  // namespace deformlab::test
