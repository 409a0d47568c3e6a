#include "geometry/graph/placement/graph_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The bumpy plane, stretched along its axes.
Shape stretched(int n, const Eigen::Vector3d& factors) {
  Shape shape = bumpy_plane(n);
  shape.V = factors.asDiagonal() * shape.V;
  return shape;
}

std::string refused(const Shape& shape, int m) {
  return test::error_of([&] { grid_nodes(shape, m); });
}

TEST(Grid, TakesTheVertexInTheMiddleOfEachCell) {
  // 9×9 vertices in 2×2 cells of 4: their middles are the vertices (2, 2), (6, 2), (2, 6), (6, 6).
  EXPECT_THAT(grid_nodes(bumpy_plane(9), 4), ElementsAre(20, 24, 56, 60));
}

TEST(Grid, FollowsTheTwoLongerSidesOfTheBox) {
  const Shape wide = stretched(41, {2, 1, 1});
  Shape turned = wide;
  turned.V.row(0) = wide.V.row(2);
  turned.V.row(1) = wide.V.row(0);
  turned.V.row(2) = wide.V.row(1);
  const std::vector<int> nodes = grid_nodes(wide, 8);
  EXPECT_EQ(grid_nodes(turned, 8), nodes);
  // SimdBlock along and two across, half a cell from the border.
  for (int j = 0; j < 8; ++j) {
    EXPECT_NEAR(wide.V(0, nodes[j]), 0.25 + 0.5 * (j % 4), 0.026);
    EXPECT_NEAR(wide.V(1, nodes[j]), 0.25 + 0.5 * (j / 4), 0.013);
  }
}

TEST(Grid, CountsThatMakeNoRegularGridNameThoseBesideThem) {
  EXPECT_THAT(refused(bumpy_plane(30), 7),
              AllOf(HasSubstr("nodes is 7"), HasSubstr("at best 7 × 1"),
                    HasSubstr("take 6 (3 × 2) or 8 (4 × 2)")));
  EXPECT_THAT(refused(bumpy_plane(30), 0), HasSubstr("nodes is 0"));
  EXPECT_THAT(refused(bumpy_plane(30), -5), HasSubstr("nodes is -5"));
}

TEST(Grid, FinerThanTheShape) {
  EXPECT_THAT(refused(bumpy_plane(5), 100), HasSubstr("use fewer nodes"));
  EXPECT_THAT(refused(bumpy_plane(5), 2000000000), HasSubstr("use fewer nodes"));
}

TEST(Grid, ShapesTooThinForOne) {
  EXPECT_THAT(refused(stretched(9, {1, 0, 0}), 4), HasSubstr("this one is a line"));
  // The next count would be far beyond what is of use, and is not searched for.
  for (const double width : {1e-3, 1e-6, 1e-12, 1e-300}) {
    EXPECT_THAT(refused(stretched(9, {1, width, 0}), 4),
                AllOf(HasSubstr("no regular grid"), HasSubstr("4 × 1")))
        << width;
  }
}

}  // namespace
}  // namespace deformlab::test
