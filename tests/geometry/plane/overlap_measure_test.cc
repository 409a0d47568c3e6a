#include "geometry/plane/overlap/overlap_measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geometry/core/error.h"
#include "tests/support/errors.h"
#include "tests/support/plane.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

/// Two sheets of n×n squares over the unit square, the second shifted by `shift`.
Triangulation two_sheets(int n, const Eigen::Vector2d& shift) {
  const Triangulation one = sheet(n + 1, n + 1, 1.0 / n);
  const Eigen::Index vertices = one.V.cols(), faces = one.F.cols();
  Triangulation both{Eigen::Matrix2Xd(2, 2 * vertices), Eigen::Matrix3Xi(3, 2 * faces)};
  both.V << one.V, one.V.colwise() + shift;
  both.F << one.F, one.F.array() + static_cast<int>(vertices);
  return both;
}

Interpenetration measured(const Triangulation& mesh, const Eigen::Matrix3Xd& depth) {
  return interpenetration(mesh, OverlapFinder(mesh)(mesh.V), depth);
}

/// A depth a vertex of the first sheet, and another of the second.
Eigen::Matrix3Xd depths(const Triangulation& mesh,
                        const std::function<double(const Eigen::Vector2d&)>& first,
                        const std::function<double(const Eigen::Vector2d&)>& second) {
  const Eigen::Index half = mesh.V.cols() / 2;
  Eigen::VectorXd depth(mesh.V.cols());
  for (Eigen::Index v = 0; v < depth.size(); ++v) {
    depth[v] = (v < half ? first : second)(mesh.V.col(v));
  }
  return vertex_depths(mesh.F, depth);
}

TEST(Interpenetration, IsTheAreaBehindAPlane) {
  for (const int n : {1, 3, 8}) {
    SCOPED_TRACE(n);
    const Triangulation mesh = two_sheets(n, {0, 0});
    const auto tilted = depths(
        mesh, [](const auto& p) { return p[0]; }, [](const auto&) { return 0.25; });
    const Interpenetration quarter = measured(mesh, tilted);
    EXPECT_NEAR(quarter.overlap, 1, 1e-12);
    EXPECT_NEAR(quarter.area, 0.25, 1e-12);
    EXPECT_NEAR(quarter.worst, 0.25, 1e-12);
    EXPECT_NEAR(quarter.share(), 0.25, 1e-12);
    const auto diagonal = depths(
        mesh, [](const auto& p) { return p[0]; }, [](const auto& p) { return 1.5 - p[1]; });
    EXPECT_NEAR(measured(mesh, diagonal).area, 0.125, 1e-12);  // beyond x + y = 1.5
  }
}

TEST(Interpenetration, IsExactlyNoneWhereOneSheetIsInFront) {
  const Triangulation mesh = two_sheets(7, {0.31, 0.17});
  const auto wavy = [](const auto& p) { return std::sin(9 * p[0]); };
  const auto above = [](const auto&) { return 1; };
  EXPECT_EQ(measured(mesh, depths(mesh, wavy, above)).area, 0);
  EXPECT_EQ(measured(mesh, depths(mesh, above, wavy)).area, 0);
  EXPECT_EQ(measured(mesh, depths(mesh, above, wavy)).worst, 0);
  EXPECT_NEAR(measured(mesh, depths(mesh, above, wavy)).overlap, 0.69 * 0.83, 1e-12);
}

TEST(Interpenetration, IsHalfWhereDepthsAreEqual) {
  const Triangulation mesh = two_sheets(4, {0.5, 0.5});
  EXPECT_NEAR(measured(mesh, triangle_depths(Eigen::VectorXd::Zero(mesh.F.cols()))).area, 0.125,
              1e-12);
  const auto same = [](const auto& p) { return p[0] + 2 * p[1]; };
  EXPECT_NEAR(measured(mesh, depths(mesh, same, same)).share(), 0.5, 1e-6);
}

TEST(Interpenetration, IsOfTheSheetThatIsInFrontLess) {
  const Triangulation mesh = two_sheets(4, {0, 0});
  Eigen::VectorXd depth = Eigen::VectorXd::Zero(mesh.F.cols());
  depth.tail(mesh.F.cols() / 2).setConstant(1);
  depth.head(8).setConstant(2);  // the first row of squares
  EXPECT_NEAR(measured(mesh, triangle_depths(depth)).area, 0.25, 1e-12);
  EXPECT_NEAR(measured(mesh, triangle_depths(-depth)).area, 0.25, 1e-12);
}

TEST(Interpenetration, IsNothingWithoutOverlap) {
  const Triangulation mesh = two_sheets(2, {2, 0});
  const Interpenetration none =
      measured(mesh, triangle_depths(Eigen::VectorXd::Zero(mesh.F.cols())));
  EXPECT_EQ(none.overlap, 0);
  EXPECT_EQ(none.share(), 0);
}

TEST(Interpenetration, DoesNotDependOnMotionOrUnits) {
  const Triangulation mesh = two_sheets(6, {0.21, 0.13});
  const auto depth = depths(
      mesh, [](const auto& p) { return p[0]; }, [](const auto& p) { return 0.7 - p[1] / 2; });
  const Interpenetration before = measured(mesh, depth);
  EXPECT_GT(before.share(), 0.1);
  Triangulation moved = mesh;
  moved.V = (rotation(0.8) * mesh.V).colwise() + Eigen::Vector2d(-3, 8);
  EXPECT_NEAR(measured(moved, depth).area, before.area, 1e-12);
  moved.V = 0x1p-90 * mesh.V;
  EXPECT_EQ(measured(moved, 0x1p70 * depth).share(), before.share());
}

TEST(Interpenetration, RefusesDepthsThatDoNotFit) {
  const Triangulation mesh = two_sheets(2, {0, 0});
  const auto refused = [&](const Eigen::Matrix3Xd& depth) -> std::string {
    return test::error_of([&] { measured(mesh, depth); });
  };
  EXPECT_EQ(refused(Eigen::Matrix3Xd::Zero(3, 15)),
            "depths of 15 triangles cannot be measured on 16; each triangle needs three that are "
            "finite");
  EXPECT_THAT(refused(Eigen::Matrix3Xd::Constant(3, 16, NAN)), HasSubstr("that are finite"));
  EXPECT_THROW(vertex_depths(mesh.F, Eigen::VectorXd::Zero(17)), InputError);
  EXPECT_NO_THROW(vertex_depths(mesh.F, Eigen::VectorXd::Zero(18)));
}

}  // namespace
}  // namespace deformlab::test
