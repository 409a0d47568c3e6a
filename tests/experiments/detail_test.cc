#include "experiments/measure/detail.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/shapes.h"

namespace deformlab {
namespace {

const Shape& bumps() {
  static const Shape shape = test::bumpy_plane(60, 1, 0.03);
  return shape;
}

Shape mapped(const Shape& shape, auto&& map) {
  Shape result = shape;
  for (auto v : result.V.colwise()) v = map(Eigen::Vector3d(v));
  return result;
}

TEST(Detail, ARigidMotionKeepsAllOfIt) {
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const Shape moved =
      mapped(bumps(), [&](const auto& v) -> Eigen::Vector3d { return Q * v + Q.col(0); });
  const Metrics m = detail(bumps(), moved, 0.1);
  EXPECT_LT(m.at("detail_turn"), 1e-5);
  EXPECT_LT(m.at("detail_length_error"), 1e-9);
  EXPECT_GT(m.at("detail_rms"), 1e-3);
}

TEST(Detail, BumpsThatDoNotTurnWithTheSurfaceAreSeen) {
  // z rises by x: the surface turns by 45°, its bumps still point along z.
  const Shape sheared = mapped(bumps(), [](const auto& v) -> Eigen::Vector3d {
    return {v.x(), v.y(), v.z() + v.x()};
  });
  EXPECT_NEAR(detail(bumps(), sheared, 0.1).at("detail_turn"), 45, 8);
}

TEST(Detail, BumpsThatGrowAreSeen) {
  const Shape taller = mapped(bumps(), [](const auto& v) -> Eigen::Vector3d {
    return {v.x(), v.y(), 1.5 * v.z()};
  });
  EXPECT_NEAR(detail(bumps(), taller, 0.1).at("detail_length_error"), 0.5, 0.1);
}

TEST(Detail, AFlatSheetHasNone) {
  const Shape flat = test::bumpy_plane(30, 1, 0);
  const Metrics m = detail(flat, flat, 0.05);
  EXPECT_EQ(m.count("detail_turn"), 0u);
  const Shape wavy = mapped(flat, [](const auto& v) -> Eigen::Vector3d {
    return {v.x(), v.y(), 0.01 * std::sin(60 * v.x())};
  });
  EXPECT_GT(detail(flat, wavy, 0.05).at("detail_rms"), 1e-3);
}

TEST(Detail, APointSetHasNone) {
  EXPECT_TRUE(detail(test::point_set(9), test::point_set(9), 0.1).empty());
}

}  // namespace
}  // namespace deformlab
