#include "deformers/arap_2d/rest_mesh_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "deformers/arap_2d/closed_form_steps.h"
#include "tests/deformers/arap_2d/handle_cases.h"
#include "tests/support/errors.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

std::string refusal(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  return error_of([&] { ClosedFormSteps(mesh, weights); });
}

TEST(RestMeshCheck, RefusesWhatCannotBeDeformed) {
  const Triangulation good = square();
  Triangulation mesh = good;
  mesh.V.col(1) = mesh.V.col(0);
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("edge of length 0, from vertex 0 to 1"));
  mesh = good;
  mesh.F(0, 0) = 999;
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("0 to 120"));
  mesh = good;
  mesh.V.conservativeResize(2, 122);
  mesh.V.col(121).setZero();
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("vertex 121 belongs to no triangle"));
  mesh = good;
  mesh.V(0, 7) = std::nan("");
  EXPECT_THAT(refusal(mesh, ones(mesh)), HasSubstr("vertex 7"));
  EXPECT_THAT(refusal({good.V, Eigen::Matrix3Xi(3, 0)}, {}), HasSubstr("no triangle"));
  EXPECT_THAT(refusal(good, Eigen::VectorXd::Ones(3)), HasSubstr("3 weights for 200"));
  Eigen::VectorXd weights = ones(good);
  weights[4] = -1;
  EXPECT_THAT(refusal(good, weights), HasSubstr("triangle 4 is -1"));
  weights[4] = 1e9;
  EXPECT_THAT(refusal(good, weights), HasSubstr("1e6 times"));
}

}  // namespace
}  // namespace deformlab::test
