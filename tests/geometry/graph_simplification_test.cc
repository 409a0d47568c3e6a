#include "geometry/graph/placement/graph_simplification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refused(const Shape& shape, int m, double ratio) {
  return test::error_of([&] { simplify(shape, m, ratio); });
}

double worst_ratio(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  double worst = 1;
  for (const auto t : T.colwise()) {
    worst = std::max(worst, aspect_ratio(V.col(t[0]), V.col(t[1]), V.col(t[2])));
  }
  return worst;
}

// Twice the area of the triangles, seen from above; negative for those that lie upside down.
Eigen::VectorXd areas_from_above(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  Eigen::VectorXd A(T.cols());
  for (Eigen::Index t = 0; t < T.cols(); ++t) {
    const Eigen::Vector3d a = V.col(T(0, t)), b = V.col(T(1, t)), c = V.col(T(2, t));
    A[t] = (b - a).cross(c - a).z();
  }
  return A;
}

TEST(AspectRatio, IsCircumradiusOverTwiceTheInradius) {
  const Eigen::Vector3d o(0, 0, 0), x(1, 0, 0);
  EXPECT_NEAR(aspect_ratio(o, x, {0.5, std::numbers::sqrt3 / 2, 0}), 1, 1e-15);
  // Legs 3 and 4: R = 5/2, r = 1.
  EXPECT_NEAR(aspect_ratio(o, {3, 0, 0}, {0, 0, 4}), 1.25, 1e-15);
  EXPECT_NEAR(aspect_ratio(o, {3e20, 0, 0}, {0, 0, 4e20}), 1.25, 1e-15);
  EXPECT_EQ(aspect_ratio(o, x, 2 * x), std::numeric_limits<double>::infinity());
  EXPECT_EQ(aspect_ratio(o, o, o), std::numeric_limits<double>::infinity());
}

TEST(Simplification, MeetsTheCountWithVerticesOfTheShape) {
  const Shape plane = bumpy_plane(30);
  for (const int m : {20, 100, 899, 900}) {
    const Simplified mesh = simplify(plane, m, 3);
    ASSERT_EQ(std::ssize(mesh.vertices), m);
    EXPECT_TRUE(std::is_sorted(mesh.vertices.begin(), mesh.vertices.end()));
    EXPECT_EQ(std::adjacent_find(mesh.vertices.begin(), mesh.vertices.end()), mesh.vertices.end());
    EXPECT_GE(mesh.vertices.front(), 0);
    EXPECT_LT(mesh.vertices.back(), 900);
    for (const int v : mesh.T.reshaped()) {
      EXPECT_TRUE(std::binary_search(mesh.vertices.begin(), mesh.vertices.end(), v));
    }
  }
}

TEST(Simplification, RestrictsTheAspectRatioAndTurnsNothingOver) {
  Shape plane = bumpy_plane(40, 1, 0);
  const double given = worst_ratio(plane.V, triangles(plane));
  for (const double most : {2.0, 3.0, 6.0}) {
    const Simplified mesh = simplify(plane, 120, most);
    EXPECT_LE(worst_ratio(plane.V, mesh.T), std::max(most, given) * (1 + 1e-12)) << most;
    const Eigen::VectorXd A = areas_from_above(plane.V, mesh.T);
    EXPECT_GT(A.minCoeff(), 0) << most;
    EXPECT_LE(A.sum(), 2 + 1e-12) << most;
    EXPECT_GT(A.sum(), 1.95) << most;  // the border stays but for the corners, which may be cut off
  }
}

TEST(Simplification, SpreadsTheNodes) {
  const Shape plane = bumpy_plane(60);
  const Simplified mesh = simplify(plane, 100, 3);
  const Eigen::Matrix3Xd g = plane.V(Eigen::all, mesh.vertices);
  double farthest = 0;
  for (const auto v : plane.V.colwise()) {
    farthest = std::max(farthest, (g.colwise() - v).colwise().norm().minCoeff());
  }
  EXPECT_LT(farthest, 0.17);  // of a side of 1: a square of 10×10 nodes would leave 0.08
}

TEST(Simplification, KeepsEveryPartOfTheMesh) {
  const Shape two = side_by_side(tube(20), tube(20), {0, 5, 0});
  const Simplified mesh = simplify(two, 60, 4);
  const auto half = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), 240);
  EXPECT_GT(half - mesh.vertices.begin(), 20);
  EXPECT_GT(mesh.vertices.end() - half, 20);
}

TEST(Simplification, IsTheSameTwiceAndInAnyUnit) {
  const Shape plane = bumpy_plane(30);
  Shape in_km = plane;
  in_km.V /= 1024;
  const std::vector<int> vertices = simplify(plane, 80, 3).vertices;
  EXPECT_EQ(simplify(plane, 80, 3).vertices, vertices);
  EXPECT_EQ(simplify(in_km, 80, 3).vertices, vertices);
}

TEST(Simplification, ACountThatCannotBeReachedSaysHowFarItCame) {
  const std::string error = refused(bumpy_plane(30), 3, 1.5);
  EXPECT_THAT(error, AllOf(HasSubstr("nodes is 3"), HasSubstr("ends at "),
                           HasSubstr("aspect ratio above 1.5"), HasSubstr("sampling")));
  const int reached = std::stoi(error.substr(error.find("ends at ") + 8));
  EXPECT_GT(reached, 3);
  EXPECT_EQ(std::ssize(simplify(bumpy_plane(30), reached, 1.5).vertices), reached);
}

TEST(Simplification, OptionsAndShapesThatCannotBe) {
  const Shape plane = bumpy_plane(10);
  EXPECT_THAT(refused(plane, 0, 3), HasSubstr("nodes is 0"));
  EXPECT_THAT(refused(plane, 101, 3), AllOf(HasSubstr("nodes is 101"), HasSubstr("1 to 100")));
  for (const double ratio : {0.99, 0.0, -1.0, double(NAN)}) {
    EXPECT_THAT(refused(plane, 20, ratio), HasSubstr("aspect_ratio")) << ratio;
  }
  EXPECT_THAT(refused(point_set(50), 20, 3), HasSubstr("no faces"));
  Shape fins = plane;
  fins.faces.push_back({0, 1, 55});
  fins.faces.push_back({1, 0, 77});
  EXPECT_THAT(refused(fins, 20, 3), HasSubstr("manifold"));
}

TEST(Simplification, TrianglesOfNoAreaDoNotStopIt) {
  Shape plane = bumpy_plane(20);
  plane.V.col(105) = plane.V.col(106);
  plane.V.col(210) = (plane.V.col(209) + plane.V.col(211)) / 2;
  EXPECT_EQ(std::ssize(simplify(plane, 60, 4).vertices), 60);
}

}  // namespace
}  // namespace deformlab::test
