#include "experiments/subjects/animation/frame_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Frame f of a tube that bends, with its vertices in another order.
Shape frame_of(int f, const std::vector<int>& order, bool keeps_faces = false) {
  const Shape rest = tube(30);
  Shape shape;
  shape.V = rest.V;
  shape.V.row(1) += 0.01 * f * rest.V.row(0).cwiseAbs2();
  shape.V = Eigen::Matrix3Xd(shape.V(Eigen::all, order));
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  shape.faces = rest.faces;
  for (auto& face : shape.faces) {
    for (int& v : face) v = keeps_faces ? v : place[v];
  }
  return shape;
}

std::vector<int> in_order() {
  std::vector<int> order(tube(30).V.cols());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<int> mixed() {
  std::vector<int> order = in_order();
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  return order;
}

std::string error_of_frames(const std::vector<Shape>& frames) {
  return error_of([&] {
    FrameOrder order;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      order.add(frames[f], static_cast<int>(f), "in-" + std::to_string(f) + ".obj");
    }
  });
}

TEST(FrameOrder, TakesFramesThatMove) {
  EXPECT_EQ(
      error_of_frames({frame_of(0, in_order()), frame_of(1, in_order()), frame_of(9, in_order())}),
      "");
}

TEST(FrameOrder, TellsWhereFacesDiffer) {
  const std::string error =
      error_of_frames({frame_of(0, in_order()), frame_of(1, in_order()), frame_of(2, mixed())});
  EXPECT_THAT(error, AllOf(HasSubstr("frame 2, 'in-2.obj', has other faces than frame 0"),
                           HasSubstr("another order")));
}

TEST(FrameOrder, TellsWhereTheSameFacesJoinOtherVertices) {
  const std::string error = error_of_frames(
      {frame_of(0, in_order()), frame_of(1, in_order()), frame_of(2, mixed(), true)});
  EXPECT_THAT(error, AllOf(HasSubstr("frame 2, 'in-2.obj', seems to have"),
                           HasSubstr("another order than frame 1")));
}

TEST(FrameOrder, TellsItOfPointsWithoutFaces) {
  std::vector<Shape> frames{frame_of(0, in_order()), frame_of(1, in_order()), frame_of(2, mixed())};
  for (Shape& frame : frames) frame.faces.clear();
  EXPECT_THAT(error_of_frames(frames), HasSubstr("frame 2, 'in-2.obj', seems to have"));
  frames[2] = frame_of(2, in_order());
  frames[2].faces.clear();
  EXPECT_EQ(error_of_frames(frames), "");
}

TEST(FrameOrder, TheListOfFacesMayBeSortedOtherwise) {
  Shape other = frame_of(1, in_order());
  std::reverse(other.faces.begin(), other.faces.end());
  for (auto& face : other.faces) std::rotate(face.begin(), face.begin() + 1, face.end());
  EXPECT_EQ(error_of_frames({frame_of(0, in_order()), other}), "");
}

TEST(FrameOrder, GrowthAndASinglePointAreNoJump) {
  Shape grown = frame_of(0, in_order());
  grown.V *= 100;
  EXPECT_EQ(error_of_frames({frame_of(0, in_order()), grown}), "");
  Shape point;
  point.V.setZero(3, 1);
  EXPECT_EQ(error_of_frames({point, point}), "");
}

TEST(FrameOrder, TellsAnotherNumberOfVertices) {
  Shape fewer = frame_of(1, in_order());
  fewer.V.conservativeResize(3, 12);
  fewer.faces.clear();
  EXPECT_THAT(error_of_frames({frame_of(0, in_order()), fewer}),
              HasSubstr("frame 1, 'in-1.obj', has 12 vertices, but frame 0 has 360"));
}

}  // namespace
}  // namespace deformlab::test
