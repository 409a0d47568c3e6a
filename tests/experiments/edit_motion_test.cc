#include "experiments/subjects/shape/edit_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/edits.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d at(double x, double y, double z) { return {x, y, z}; }

/// Vertices 0..2 on a line, 3..5 a triangle around (2, 1, 0).
Shape row_and_triangle() {
  Shape shape;
  shape.V.resize(3, 6);
  shape.V << 0, 1, 2, 1, 3, 2, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0;
  return shape;
}

ResolvedEdit resolved(const std::string& text) {
  return resolve(read_edit_text(text), row_and_triangle());
}

std::string error_of(const std::string& text) { return edit_error_of(text, row_and_triangle()); }

bool says_nothing(const Eigen::Vector3d& turn) { return turn.array().isNaN().all(); }

TEST(EditMotion, SaysHowHandlesTurn) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [0]}, fix: true}\n"
      "- {select: {vertices: [3, 4, 5]}, rotate: {axis: [0, 0, 2], degrees: -270}, by: [0, 0, 1]}\n"
      "- {select: {vertices: [1]}, to: [7, 8, 9]}\n"
      "- {select: {point: [0, 1, 0]}, rotate: {axis: [0, 3, 0], degrees: 360}}\n"
      "- {select: {point: [0, 1, 1]}, by: [0, 0, 1]}\n");
  const Eigen::Matrix3Xd& turns = edit.handles.rotations;
  ASSERT_EQ(turns.cols(), edit.targets.cols());
  ASSERT_EQ(turns.cols(), 6);
  EXPECT_LT((turns.col(0) - at(0, 0, -1.5 * kPi)).norm(), 1e-14) << "not reduced";
  EXPECT_EQ(turns.col(0), turns.col(2));
  EXPECT_TRUE(says_nothing(turns.col(3))) << "one vertex";
  EXPECT_LT((turns.col(4) - at(0, 2 * kPi, 0)).norm(), 1e-14);
  EXPECT_TRUE(says_nothing(turns.col(5))) << "one point";
  EXPECT_THAT(edit.handles.groups, ElementsAre(1, 1, 1, 2, 3, 4));
}

TEST(EditMotion, ATranslatedGroupDoesNotTurn) {
  for (const std::string motion : {"by: [0, 1, 0]", "to: [0, 1, 0]"}) {
    const ResolvedEdit edit = resolved(
        "- {select: {vertices: [3, 4, 5]}, " + motion + "}\n- {select: {vertices: [0, 1]}, " +
        motion + "}\n- {select: {vertices: [2]}, rotate: {axis: [1, 0, 0], degrees: 20}}");
    EXPECT_EQ(edit.handles.rotations.leftCols(3), Eigen::Matrix3Xd::Zero(3, 3)) << motion;
    EXPECT_TRUE(says_nothing(edit.handles.rotations.col(3))) << "on a line: " << motion;
  }
}

TEST(EditMotion, SaysNothingWhereNothingTurns) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [1, 2]}, by: [0, 1, 0]}\n- {select: {vertices: [4]}, fix: true}");
  EXPECT_EQ(edit.handles.rotations.cols(), 0);
  EXPECT_THAT(edit.handles.groups, ElementsAre(0, 0));
  EXPECT_EQ(edit.handles.weights.size(), 0);
}

TEST(EditMotion, AVertexOfTwoEntriesTurnsAsTheOneThatRotates) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [3]}, by: [0, 0, 0]}\n"
      "- {select: {vertices: [3, 4, 5]}, rotate: {axis: [0, 0, 1], degrees: 360}}");
  EXPECT_THAT(edit.handles.groups, ElementsAre(1, 1, 1));
  for (const auto& turn : edit.handles.rotations.colwise()) {
    EXPECT_LT((turn - at(0, 0, 2 * kPi)).norm(), 1e-14);
  }
}

TEST(EditMotion, ScalesThenRotatesThenTranslates) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [1]}, scale: {factor: [3, 1, 1], center: [0, 0, 0]},\n"
      "   rotate: {axis: [0, 0, 1], degrees: 90, center: [1, 0, 0]}, by: [0, 0, 5]}\n"
      "- {select: {vertices: [3, 4, 5]}, scale: {factor: 2}}\n");
  EXPECT_LT((edit.targets.col(0) - at(1, 2, 5)).norm(), 1e-14);
  EXPECT_LT((edit.targets.col(1) - at(0, -1, 0)).norm(), 1e-14) << "about the centroid";
  EXPECT_LT((edit.targets.col(3) - at(2, 5, 0)).norm(), 1e-14);
}

TEST(EditMotion, AMatrixTakesPlacesToTargets) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [3, 4, 5]},\n"
      "   matrix: [[0, -2, 0, 1], [3, 0, 0, 0], [0, 0, 1, 7], [0, 0, 0, 1]]}");
  EXPECT_LT((edit.targets.col(0) - at(1, 3, 7)).norm(), 1e-13);
  EXPECT_LT((edit.targets.col(2) - at(-5, 6, 7)).norm(), 1e-13);
  EXPECT_LT((edit.handles.rotations.col(0) - at(0, 0, kPi / 2)).norm(), 1e-13);
}

TEST(EditMotion, AMirrorImageIsARotationAndAStretch) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [3, 4, 5]},\n"
      "   matrix: [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}");
  EXPECT_LT((edit.targets.col(1) - at(-3, 0, 0)).norm(), 1e-13);
  EXPECT_TRUE(edit.handles.rotations.allFinite());
}

TEST(EditMotion, ReadsTargetsOfAFile) {
  put_temporary("t.csv", "index,x,y,z\n3, 1, 2, 3\n# a comment\n\n0.5;0;0 ; 4;5;6\n1 7 8 9\n");
  const ResolvedEdit edit = resolved("- {targets: t.csv}\n- {select: {vertices: [5]}, fix: true}");
  EXPECT_THAT(edit.handles.moved, ElementsAre(3, 1));
  ASSERT_EQ(edit.handles.points.cols(), 1);
  EXPECT_EQ(edit.handles.points.col(0), at(0.5, 0, 0));
  Eigen::Matrix3Xd expected(3, 3);
  expected << 1, 7, 4, 2, 8, 5, 3, 9, 6;
  EXPECT_EQ(edit.targets, expected);
  EXPECT_THAT(edit.handles.groups, ElementsAre(2, 4, 3)) << "each moves by itself";
}

TEST(EditMotion, TargetsOfOneRigidMotionMoveTogether) {
  const auto groups_of = [](const std::string& targets) {
    put_temporary("t.csv", targets);
    return resolved("- {targets: t.csv}").handles.groups;
  };
  const std::string two_places = "0 0 0  5 5 5\n1 0 0  5 6 5\n";
  EXPECT_THAT(groups_of(two_places + "0 1 0  4 5 5\n"), ElementsAre(1, 1, 1));
  EXPECT_THAT(groups_of(two_places + "2 0 0  5 7 5\n"), ElementsAre(1, 1, 1)) << "a line";
  EXPECT_THAT(groups_of(two_places + "0 1 0  4 5.1 5\n"), ElementsAre(1, 2, 3)) << "sheared";
  EXPECT_THAT(groups_of(two_places), ElementsAre(1, 2)) << "any two places do";
}

TEST(EditMotion, RefusesFilesThatAreNoTargets) {
  const auto refused = [](const std::string& text) {
    put_temporary("bad.csv", text);
    return error_of("- {targets: bad.csv}");
  };
  EXPECT_THAT(refused("1,2,3\n"), AllOf(HasSubstr("expected 4 numbers"), HasSubstr("line 1 of")));
  EXPECT_THAT(refused("x\n1,2,3,a\n"), AllOf(HasSubstr("line 2 of"), HasSubstr("'1,2,3,a'")));
  EXPECT_THAT(refused("1.5,2,3,4\n"), HasSubstr("the index of a vertex"));
  EXPECT_THAT(refused("1,2,3,nan\n"), HasSubstr("line 1 of"));
  EXPECT_THAT(refused("-1,2,3,4\n"), HasSubstr("line 1 of"));
  EXPECT_THAT(refused("9,2,3,4\n"), HasSubstr("vertex 9 does not exist"));
  EXPECT_THAT(refused("index,x,y,z\n"), HasSubstr("has no targets"));
  EXPECT_THAT(refused("0,1e99,0,0\n"), HasSubstr("beyond the range"));
  EXPECT_THAT(refused("0,1,1,1\n0,2,2,2\n"), HasSubstr("keep one"));
  EXPECT_THAT(error_of("- {targets: absent.csv}"), HasSubstr("absent.csv"));
}

TEST(EditMotion, WeighsHandlesByEntry) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [1, 2]}, by: [0, 1, 0]}\n"
      "- {select: {vertices: [4]}, by: [0, 1, 0], weight: 0.25}");
  EXPECT_EQ(edit.handles.weights, Eigen::Vector3d(1, 1, 0.25));
}

TEST(EditMotion, RefusesWhatMeansNothing) {
  const std::string one = "- {select: {all: true}, ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {one + "scale: {factor: 0}}", "must be above 0"},
      {one + "scale: {factor: [1, -1, 1]}}", "must be above 0"},
      {one + "scale: {factor: [1, 1]}}", "a list of 3 numbers"},
      {one + "scale: {center: [0, 0, 0]}}", "missing key 'factor'"},
      {one + "matrix: [[1, 0, 0, 0]]}", "4 rows of 4 numbers"},
      {one + "matrix: [[1, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0]]}", "4 rows of 4 numbers"},
      {one + "matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]}", "last row"},
      {one + "matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], by: [0, 0, 1]}",
       "found several"},
      {one + "scale: {factor: 2}, to: [0, 0, 0]}", "found several"},
      {one + "by: [0, 0, 1], weight: 0}", "weight"},
      {one + "by: [0, 0, 1], weight: .inf}", "a finite number"},
      {one + "fix: true, weight: 2}", "has no 'weight'"},
      {one + "targets: t.csv}", "leave 'select' out"},
      {"- {by: [0, 0, 1]}", "missing key 'select'"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_THAT(error_of(text), AllOf(HasSubstr(message), HasSubstr("line 1 of e.yaml"))) << text;
  }
}

Pose pose(const Eigen::Vector3d& rest, const Eigen::Vector3d& target, const Motion& motion) {
  return {rest, target - rest, motion};
}

TEST(EditMotion, ARotationGoesAlongAnArcByAnyAngle) {
  const Eigen::Vector3d rest = at(2, 0, 0);
  for (const double degrees : {90., 180., 270., 360., 720.}) {
    Motion turn;
    turn.center = at(1, 0, 0);
    turn.turn = at(0, 0, degrees * kPi / 180);
    const Pose first = pose(rest, rest, {}), last = pose(rest, turn(rest), turn);
    for (const double share : {0., 0.25, 0.5, 1.}) {
      const double angle = share * degrees * kPi / 180;
      const Eigen::Vector3d expected = at(1 + std::cos(angle), std::sin(angle), 0);
      const Eigen::Vector3d found = rest + offset_between(first, last, share);
      EXPECT_LT((found - expected).norm(), 1e-13) << degrees << " " << share;
      const std::vector<PoseNumbers> numbers = numbers_of({first, last});
      const PoseNumbers between = numbers[0] + share * (numbers[1] - numbers[0]);
      EXPECT_NEAR(between[kTurnOfNumbers + 2], angle, 1e-13) << "it is not reduced";
    }
  }
}

TEST(EditMotion, TheStepsOfADragTurnAlongArcsToo) {
  const ResolvedEdit edit = resolved(
      "- {select: {vertices: [3, 4, 5]}, rotate: {axis: [0, 0, 1], degrees: 180}}\n"
      "- {select: {vertices: [1]}, by: [0, 4, 0]}");
  Eigen::Matrix3Xd rest(3, 4);
  rest << row_and_triangle().V.rightCols(3), row_and_triangle().V.col(1);
  const Eigen::Matrix3Xd half = edit.targets_at(0.5, rest);
  EXPECT_LT((half.col(0) - at(3, 0, 0)).norm(), 1e-13) << "a quarter turn about (2, 1, 0)";
  EXPECT_EQ(half.col(3), at(1, 2, 0));
  EXPECT_LT((edit.targets_at(1, rest) - edit.targets).norm(), 1e-13);
  EXPECT_LT((edit.targets_at(0, rest) - rest).norm(), 1e-13);
}

TEST(EditMotion, TranslationsGoStraight) {
  Motion shift;
  shift.shift = at(0, 4, 0);
  const Pose first = pose(at(1, 0, 0), at(1, 0, 2), {}),
             last = pose(at(1, 0, 0), at(1, 4, 0), shift);
  EXPECT_EQ(offset_between(first, last, 0.5), at(0, 2, 1));
}

TEST(EditMotion, SizesChangeInProportion) {
  Motion scale;
  scale.center = at(1, 0, 0);
  scale.stretch *= 3;
  const Eigen::Vector3d rest = at(2, 0, 0);
  EXPECT_LT(
      (offset_between(pose(rest, rest, {}), pose(rest, scale(rest), scale), 0.5) - at(1, 0, 0))
          .norm(),
      1e-14);
}

}  // namespace
}  // namespace deformlab::test
