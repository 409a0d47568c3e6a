#include "render/upright.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

const Vector3d kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

// A body on four legs that stand apart, with a head in front; `up` is the axis of its height.
Matrix3Xd animal(int up) {
  Matrix3Xd points(3, 8);
  points << 0, 4, 0, 4, 2, 2, 5.5, -1,  //
      0, 0, 2, 2, 1, 1, 1, 1,           //
      0, 0, 0, 0, 2, 3, 4, 2.5;
  if (up == 1) points.row(1).swap(points.row(2));
  return points;
}

TEST(Upright, AFigureOnItsFeetStandsOnThem) {
  EXPECT_EQ(upright_axis(animal(1)), kY);
  EXPECT_EQ(upright_axis(animal(2)), kZ);
}

TEST(Upright, IsZWhereNothingDecides) {
  EXPECT_EQ(upright_axis(Matrix3Xd(3, 0)), kZ);
  EXPECT_EQ(upright_axis(Matrix3Xd::Zero(3, 5)), kZ);
  EXPECT_EQ(upright_axis(tube(10).V), kZ) << "it lies along x";
  Matrix3Xd column = tube(10).V;
  column.row(0).swap(column.row(1));
  EXPECT_EQ(upright_axis(column), kZ) << "its top is as wide as its stand";
  EXPECT_EQ(upright_axis(bumpy_plane(15).V), kZ);
  EXPECT_EQ(upright_axis(bumpy_plane(15, 1, 0).V), kZ);
}

}  // namespace
}  // namespace deformlab::test
