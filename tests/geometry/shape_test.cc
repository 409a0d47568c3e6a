#include "geometry/shape/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/errors.h"

namespace deformlab {
namespace {

using ::testing::HasSubstr;

/// A unit square as one quad, a pentagon's worth of corners, and a vertex that nothing uses.
Shape square() {
  Shape shape;
  shape.V.resize(3, 5);
  shape.V << 0, 1, 1, 0, 7,  //
      0, 0, 1, 1, 7,         //
      0, 0, 0, 0, 7;
  shape.faces = {{0, 1, 2, 3}};
  return shape;
}

std::string complaint(const Shape& shape) {
  return test::error_of([&] { check(shape, "thing"); });
}

TEST(Shape, CheckAcceptsUnusedVerticesAndRepeatedFaces) {
  Shape shape = square();
  shape.faces.push_back({0, 1, 2, 3});
  shape.faces.push_back({2, 2, 2});
  EXPECT_EQ(complaint(shape), "");
}

TEST(Shape, CheckNamesWhatIsWrong) {
  EXPECT_THAT(complaint(Shape()), HasSubstr("'thing': it has no vertices"));

  Shape shape = square();
  shape.V(1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(shape), HasSubstr("vertex 3"));
  shape.V(1, 3) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint(shape), HasSubstr("inf"));

  shape = square();
  shape.faces.push_back({0, 1, 5});
  EXPECT_THAT(complaint(shape), HasSubstr("face 1 names vertex 5"));
  shape.faces.back() = {0, -1, 2};
  EXPECT_THAT(complaint(shape), HasSubstr("face 1 names vertex -1"));

  shape = square();
  shape.N = Eigen::Matrix3Xd::Zero(3, 2);
  EXPECT_THAT(complaint(shape), HasSubstr("2 normals for 5 vertices"));
}

TEST(Shape, TrianglesAreFans) {
  Shape shape = square();
  shape.faces.push_back({1, 4});
  Eigen::Matrix3Xi expected(3, 2);
  expected << 0, 0, 1, 2, 2, 3;
  EXPECT_EQ(triangles(shape), expected);
}

TEST(Shape, NormalsAreWeightedByArea) {
  Shape shape = square();
  shape.V.col(4) << 0, 0, 3;
  shape.faces.push_back({0, 3, 4});  // area 1.5, its normal is +x
  const Eigen::Matrix3Xd N = vertex_normals(shape);
  EXPECT_TRUE(N.col(1).isApprox(Eigen::Vector3d(0, 0, 1)));
  EXPECT_TRUE(N.col(0).isApprox(Eigen::Vector3d(3, 0, 2).normalized()));
}

TEST(Shape, NormalsAreZeroWhereNoTriangleHasArea) {
  Shape shape = square();
  shape.faces = {{0, 0, 1}};
  EXPECT_TRUE(vertex_normals(shape).isZero(0));
}

TEST(Shape, NormalsDoNotDependOnTheUnit) {
  Shape shape = square();
  const Eigen::Matrix3Xd expected = vertex_normals(shape);
  shape.V *= 1e-120;
  EXPECT_TRUE(vertex_normals(shape).isApprox(expected));
}

TEST(Shape, BoundingBoxDiagonal) {
  EXPECT_DOUBLE_EQ(bounding_box_diagonal(square().V), std::sqrt(3.0) * 7);
  EXPECT_EQ(bounding_box_diagonal(Eigen::Matrix3Xd(3, 0)), 0);
}

}  // namespace
}  // namespace deformlab
