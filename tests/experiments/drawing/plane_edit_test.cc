#include "experiments/subjects/drawing/plane_edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "tests/support/errors.h"

namespace deformlab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two triangles over [0, 10]².
Triangulation square() {
  Triangulation mesh{Eigen::Matrix2Xd(2, 4), Eigen::Matrix3Xi(3, 2)};
  mesh.V << 0, 10, 10, 0, 0, 0, 10, 10;
  mesh.F << 0, 0, 1, 2, 2, 3;
  return mesh;
}

std::vector<EditEntry> read(const std::string& text) {
  return read_plane_edit(parse_yaml(
      text, std::make_shared<const ConfigSource>(ConfigSource{"e.yaml", ::testing::TempDir()})));
}

ResolvedEdit resolved(const std::string& text) { return resolve(read(text), square()); }

std::string error_of(const std::string& text) {
  return test::error_of([&] { resolved(text); });
}

TEST(PlaneEdit, TakesTwoCoordinates) {
  const ResolvedEdit edit = resolved(
      "- {select: {box: {min: [9, -1], max: [11, 11]}}, by: [1, 2]}\n"
      "- {select: {circle: {center: [0, 0], radius: 1}}, to: [-3, 4]}\n"
      "- {select: {nearest: [1, 8]}, fix: true}\n");
  EXPECT_THAT(edit.handles.moved, ElementsAre(1, 2, 0));
  EXPECT_THAT(edit.handles.fixed, ElementsAre(3));
  Eigen::Matrix3Xd expected(3, 3);
  expected << 11, 11, -3, 2, 12, 4, 0, 0, 0;
  EXPECT_EQ(edit.targets, expected);
}

TEST(PlaneEdit, AHandleMayLieAnywhere) {
  const ResolvedEdit edit = resolved(
      "- {select: {point: [2, 3]}, by: [1, 1]}\n"
      "- {select: {nearest: [0, 0]}, by: [5, 5]}\n"
      "- {select: {point: [4, 4]}, fix: true}\n");
  ASSERT_EQ(edit.handles.points.cols(), 2);
  EXPECT_EQ(edit.handles.points.col(0), Eigen::Vector3d(2, 3, 0));
  EXPECT_EQ(edit.targets.col(0), Eigen::Vector3d(5, 5, 0));  // vertices come first
  EXPECT_EQ(edit.targets.col(1), Eigen::Vector3d(3, 4, 0));
  EXPECT_EQ(edit.targets.col(2), Eigen::Vector3d(4, 4, 0));
}

TEST(PlaneEdit, ARotationHandleTakesARingAlong) {
  for (const std::string rotate : {"90", "{degrees: 90}"}) {
    const ResolvedEdit edit =
        resolved("- {select: {point: [5, 5]}, rotate: " + rotate + ", by: [1, 0]}");
    ASSERT_EQ(edit.handles.points.cols(), 9);
    EXPECT_LT((edit.targets.col(0) - Eigen::Vector3d(6, 5, 0)).norm(), 1e-12);
    for (int i = 1; i < 9; ++i) {
      const Eigen::Vector3d arm = edit.handles.points.col(i) - edit.handles.points.col(0);
      EXPECT_NEAR(arm.norm(), 0.04 * std::sqrt(200.0), 1e-12);
      const Eigen::Vector3d turned(-arm.y(), arm.x(), 0);  // x towards y
      EXPECT_LT((edit.targets.col(i) - edit.targets.col(0) - turned).norm(), 1e-12);
    }
    const Eigen::Matrix3Xd quarter =
        Eigen::Vector3d(0, 0, std::numbers::pi / 2).replicate(1, edit.targets.cols());
    EXPECT_LT((edit.handles.rotations - quarter).norm(), 1e-12) << "the ring turns as the point";
  }
}

TEST(PlaneEdit, ARingStaysInsideTheShape) {
  const ResolvedEdit edit = resolved("- {select: {point: [9.9, 0.1]}, rotate: 10}");
  EXPECT_LT(edit.handles.points.cols(), 9);
  EXPECT_LE(edit.handles.points.row(0).maxCoeff(), 10);
  EXPECT_GE(edit.handles.points.row(1).minCoeff(), 0);
}

TEST(PlaneEdit, ScalesAndTakesMatricesAndFilesOfTargets) {
  std::ofstream(std::filesystem::path(::testing::TempDir()) / "plane.csv") << "3,1,2\n4,5,6,7\n";
  const ResolvedEdit edit = resolved(
      "- {select: {nearest: [10, 10]}, scale: {factor: [1, 2], center: [0, 0]}}\n"
      "- {select: {nearest: [10, 0]}, scale: {factor: 3, center: [9, 0]}}\n"
      "- {select: {nearest: [0, 0]}, matrix: [[1, 0, 4], [0, 1, 5], [0, 0, 1]]}\n"
      "- {targets: plane.csv}\n");
  EXPECT_THAT(edit.handles.moved, ElementsAre(2, 1, 0, 3));
  Eigen::Matrix3Xd expected(3, 5);
  expected << 10, 12, 4, 1, 6, 20, 0, 5, 2, 7, 0, 0, 0, 0, 0;
  EXPECT_LT((edit.targets - expected).norm(), 1e-13);
  EXPECT_THAT(error_of("- {select: {all: true}, matrix: [[1, 0], [0, 1]]}"),
              HasSubstr("3 rows of 3 numbers"));
  EXPECT_THAT(error_of("- {select: {all: true}, scale: {factor: [1, 2, 3]}}"),
              HasSubstr("two coordinates [x, y]"));
}

TEST(PlaneEdit, SaysWhatADrawingCannotHave) {
  EXPECT_THAT(error_of("- {select: {nearest: [0, 0, 0]}, fix: true}"),
              HasSubstr("two coordinates [x, y]"));
  EXPECT_THAT(error_of("- {select: {sphere: {center: [0, 0], radius: 1}}, fix: true}"),
              HasSubstr("take 'circle' (line 1 of e.yaml)"));
  EXPECT_THAT(error_of("- {select: {all: true}, rotate: {axis: [0, 0, 1], degrees: 3}}"),
              HasSubstr("leave 'axis' out"));
  EXPECT_THAT(error_of("- {select: {all: true}, by: 3}"), HasSubstr("two coordinates [x, y]"));
}

}  // namespace
}  // namespace deformlab
