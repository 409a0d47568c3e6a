#include "experiments/subjects/motion/handle_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "experiments/config/config.h"
#include "tests/support/edits.h"

namespace deformlab::test {
namespace {

using ::testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

/// A square around (1, 0, 0) in the plane z = 0, and the vertex 4 far away. It goes along y.
Shape square(int frame) {
  Shape shape;
  shape.V.resize(3, 5);
  shape.V << 0, 2, 2, 0, 9, -1, -1, 1, 1, 0, 0, 0, 0, 0, 0;
  shape.V.row(1).array() += frame;
  return shape;
}

HandleMotion motion_of(const std::string& text, int frames = 13) {
  const ConfigNode file = parse_yaml(
      text, std::make_shared<const ConfigSource>(ConfigSource{"k.yaml", ::testing::TempDir()}));
  KeyframesOptions options;
  read_value(file, "", options);
  return {read_script({}, options), {0, frames - 1}, square};
}

const std::string kSquare = "select: {vertices: [0, 1, 2, 3]}";

std::string keys(const std::string& first, const std::string& last, const std::string& more = "") {
  return "pose: 0\n" + more + "keyframes:\n  - {frame: 0, edit: [" + first +
         "]}\n  - {frame: 12, edit: [" + last + "]}\n";
}

std::string turned(int degrees, const std::string& more = "") {
  return "{" + kSquare + ", rotate: {axis: [0, 0, 1], degrees: " + std::to_string(degrees) + more +
         "}}";
}

// How far the square has turned, which is 0 ≤ angle < 360 [degree], and its size.
std::pair<double, double> angle_and_size(const HandleMotion& motion, double frame) {
  const Eigen::Matrix3Xd V = square(0).V.leftCols(4) + motion.offsets(frame).leftCols(4);
  const Eigen::Vector3d side = V.col(1) - V.col(0);
  const double angle = std::atan2(side.y(), side.x()) * 180 / kPi;
  return {angle < -1e-9 ? angle + 360 : angle, side.norm()};
}

TEST(HandleMotion, TurnsAlongAnArcByAnyAngle) {
  for (const int degrees : {90, 180, 270, 360, -180}) {
    const HandleMotion motion =
        motion_of(keys("{" + kSquare + ", by: [0, 0, 0]}", turned(degrees)));
    for (const int frame : {0, 3, 6, 9, 12}) {
      const auto [angle, size] = angle_and_size(motion, frame);
      EXPECT_NEAR(size, 2, 1e-12) << degrees << " " << frame;
      const double expected = degrees * frame / 12.0;
      EXPECT_NEAR(std::remainder(angle - expected, 360), 0, 1e-9) << degrees << " " << frame;
      const Eigen::Vector3d turn = motion.rotations(frame).col(0);
      EXPECT_NEAR(turn.z(), expected * kPi / 180, 1e-12) << "it is not reduced";
    }
  }
}

TEST(HandleMotion, GoesOnFromOneRotationToTheNext) {
  const HandleMotion motion = motion_of(keys(turned(-90), turned(270)));
  EXPECT_NEAR(angle_and_size(motion, 0).first, 270, 1e-9);
  EXPECT_NEAR(angle_and_size(motion, 6).first, 90, 1e-9);
  EXPECT_NEAR(angle_and_size(motion, 12).first, 270, 1e-9);
}

TEST(HandleMotion, SwingsAboutItsCenter) {
  const HandleMotion motion =
      motion_of(keys("{" + kSquare + ", by: [0, 0, 0]}", turned(120, ", center: [-4, 0, 0]")));
  for (const int frame : {0, 2, 6, 11, 12}) {
    const Eigen::Matrix3Xd V = square(0).V.leftCols(4) + motion.offsets(frame);
    EXPECT_NEAR((V.rowwise().mean() - Eigen::Vector3d(-4, 0, 0)).norm(), 5, 1e-12) << frame;
  }
}

TEST(HandleMotion, IsSmoothOnTheArcToo) {
  const HandleMotion motion =
      motion_of(keys("{" + kSquare + ", by: [0, 0, 0]}", turned(180), "interpolation: smooth\n"));
  EXPECT_NEAR(angle_and_size(motion, 3).first, 180 * 0.15625, 1e-9);  // 3 t² − 2 t³ at t = 1/4
  EXPECT_NEAR(angle_and_size(motion, 3).second, 2, 1e-12);
}

TEST(HandleMotion, SeveralHandlesTurnEachOnItsOwn) {
  const HandleMotion motion = motion_of(
      keys("{" + kSquare + ", by: [0, 0, 0]}, {select: {vertices: [4]}, by: [0, 0, 0]}",
           turned(180) + ", {select: {vertices: [4]}, rotate: {axis: [1, 0, 0], degrees: 40}}"));
  EXPECT_THAT(motion.handles().groups, ElementsAre(0, 0, 0, 0, 1));
  EXPECT_NEAR(motion.rotations(6)(2, 0), kPi / 2, 1e-12);
  EXPECT_NEAR(motion.rotations(6)(0, 4), kPi / 9, 1e-12);
  EXPECT_TRUE(motion.offsets(6).col(4).isZero(1e-12));
}

TEST(HandleMotion, SaysNothingAboutRotationsWhereNoEditTurns) {
  const HandleMotion motion =
      motion_of(keys("{" + kSquare + ", by: [0, 0, 0]}", "{" + kSquare + ", by: [0, 0, 3]}"));
  EXPECT_EQ(motion.rotations(6).cols(), 0);
  EXPECT_EQ(motion.offsets(4), Eigen::Vector3d(0, 0, 1).replicate(1, 4));
}

TEST(HandleMotion, EachKeyframeHoldsInItsOwnPose) {
  const HandleMotion motion =
      motion_of("keyframes:\n  - {frame: 0, edit: [{" + kSquare +
                ", by: [0, 0, 0]}]}\n  - {frame: 12, edit: [" + turned(180) + "]}\n");
  const Eigen::Matrix3Xd at_end = square(12).V.leftCols(4) + motion.offsets(12);
  EXPECT_LT((at_end.col(0) - square(12).V.col(2)).norm(), 1e-12);
  EXPECT_EQ(motion.offsets(0), Eigen::Matrix3Xd::Zero(3, 4));
  EXPECT_NEAR(angle_and_size(motion, 6).second, 2, 1e-12);
}

TEST(HandleMotion, ItsDescriptionTellsTheWayToo) {
  const auto described = [](int degrees) {
    return motion_of(keys("{" + kSquare + ", by: [0, 0, 0]}", turned(degrees))).description();
  };
  EXPECT_EQ(described(90), described(90));
  EXPECT_NE(described(0), described(360));
}

}  // namespace
}  // namespace deformlab::test
