#include "deformers/handle_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/support/errors.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

std::string refused(const Handles& handles) {
  return error_of([&] { check_handles(handles, 10); });
}

std::string refused(const Eigen::Matrix3Xd& targets, Eigen::Index count) {
  return error_of([&] { check_targets(targets, count); });
}

TEST(HandleChecks, AVertexExistsAndIsEitherFixedOrMoved) {
  EXPECT_EQ(refused({{0, 1, 1}, {9, 8}}), "");
  EXPECT_EQ(refused(Handles()), "");
  for (const int i : {-1, 10}) {
    const std::string expected =
        "vertex " + std::to_string(i) + "; the shape has the vertices 0 to 9";
    EXPECT_THAT(refused({{i}, {}}), HasSubstr(expected));
    EXPECT_THAT(refused({{}, {3, i}}), HasSubstr(expected));
  }
  EXPECT_THAT(refused({{5, 2}, {9, 2}}), HasSubstr("vertex 2 is both fixed and moved"));
  EXPECT_THAT(refused({{}, {7, 3, 7}}), HasSubstr("vertex 7 is moved twice"));
}

TEST(HandleChecks, AHandlePointIsFinite) {
  Handles handles;
  handles.points = Eigen::Matrix3Xd::Zero(3, 2);
  EXPECT_EQ(refused(handles), "");
  handles.points(1, 1) = NAN;
  EXPECT_THAT(refused(handles), HasSubstr("handle point 1 (counted from 0)"));
  EXPECT_THAT(refused(handles), HasSubstr("not finite"));
}

TEST(HandleChecks, RotationsAndGroupsAreOneForEachTargetOrNone) {
  Handles handles{.fixed = {0}, .moved = {3, 4}};
  handles.points = Eigen::Matrix3Xd::Zero(3, 1);
  handles.groups = {1, 1, 7};
  handles.rotations = Eigen::Matrix3Xd::Constant(3, 3, 9);
  EXPECT_EQ(refused(handles), "");
  handles.rotations.col(2).setConstant(NAN);
  EXPECT_EQ(refused(handles), "") << "nothing is said about this rotation";
  handles.rotations(0, 2) = 1;
  EXPECT_THAT(refused(handles), HasSubstr("rotation 2 (counted from 0) is (1, nan, nan)"));
  handles.rotations.setZero(3, 2);
  EXPECT_THAT(refused(handles), HasSubstr("2 rotations for 3 handles"));
  handles.rotations.resize(3, 0);
  handles.groups = {1, 1, 1, 1};
  EXPECT_THAT(refused(handles), HasSubstr("4 groups for 3 handles"));
}

TEST(HandleChecks, WeightsArePositiveAndOneForEachTargetOrNone) {
  Handles handles{.fixed = {0}, .moved = {3, 4}};
  handles.weights = Eigen::Vector2d(0.5, 1e6);
  EXPECT_EQ(refused(handles), "");
  EXPECT_THAT(error_of([&] { refuse_weights(handles); }), HasSubstr("leave 'weight' out"));
  for (const double bad : {0., -1., double(NAN), std::numeric_limits<double>::infinity()}) {
    handles.weights[1] = bad;
    EXPECT_THAT(refused(handles), HasSubstr("weight 1 (counted from 0)"));
  }
  handles.weights.setOnes(3);
  EXPECT_THAT(refused(handles), HasSubstr("3 weights for 2 handles"));
  handles.weights.resize(0);
  EXPECT_EQ(error_of([&] { refuse_weights(handles); }), "");
}

TEST(HandleChecks, EachHandleHasOneFiniteTarget) {
  Eigen::Matrix3Xd targets = Eigen::Matrix3Xd::Zero(3, 2);
  EXPECT_EQ(refused(targets, 2), "");
  EXPECT_THAT(refused(targets, 3), HasSubstr("2 targets for 3 handles"));
  for (const double bad : {double(NAN), std::numeric_limits<double>::infinity()}) {
    targets(2, 0) = bad;
    EXPECT_THAT(refused(targets, 2), HasSubstr("target 0 (counted from 0)"));
    EXPECT_THAT(refused(targets, 2), HasSubstr("not finite"));
  }
}

TEST(HandleChecks, MeasuresTheDistancesToTheTargets) {
  Report report;
  measure_handles(Eigen::Matrix3Xd(3, 0), Eigen::Matrix3Xd(3, 0), report);
  EXPECT_EQ(report.handle_rms, 0);
  EXPECT_EQ(report.handle_max, 0);
  Eigen::Matrix3Xd reached = Eigen::Matrix3Xd::Zero(3, 2);
  reached.col(1) << 3, 0, 4;
  measure_handles(reached, Eigen::Matrix3Xd::Zero(3, 2), report);
  EXPECT_DOUBLE_EQ(report.handle_rms, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(report.handle_max, 5);
}

}  // namespace
}  // namespace deformlab::test
