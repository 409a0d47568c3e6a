#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformers/embedded/animated_deformation.h"
#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/handles/line_turn.h"
#include "deformers/embedded/harmonic_start.h"
#include "deformers/embedded/node_states.h"
#include "deformers/embedded/presets.h"
#include "tests/support/shapes.h"

// Handles on a line do not tell how the shape rolls about it: it does not roll.
namespace deformlab::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

Matrix3d turn(const Vector3d& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kDegree, axis.normalized()).toRotationMatrix();
}

Matrix3Xd line(int count) {
  Matrix3Xd points = Matrix3Xd::Zero(3, count);
  points.row(0).setLinSpaced(count, 1, 3);
  return points;
}

TEST(ShortestTurn, TakesALineToALineWithoutARoll) {
  const Matrix3Xd p = line(4).colwise() + Vector3d(5, 6, 7);
  for (const double degrees : {0.0, 1e-9, 40.0, 90.0, 179.9, 180.0}) {
    const Matrix3d R = turn(Vector3d(0, 1, 2), degrees);
    const auto found = shortest_turn(p, R * p);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->norm(), degrees * kDegree, 1e-7);
    EXPECT_NEAR(found->x(), 0, 1e-9) << "a roll at " << degrees;
    const Matrix3d rolled = R * turn(Vector3d::UnitX(), 70);
    EXPECT_LT((*shortest_turn(p, rolled * p) - *found).norm(), 1e-7);
  }
  EXPECT_NEAR(shortest_turn(p, -p)->z(), std::numbers::pi, 1e-9) << "a half turn is about z";
}

TEST(ShortestTurn, OfPointsAtOnePlaceIsUnknown) {
  const Matrix3Xd p = line(3), one = Vector3d(1, 2, 3).replicate(1, 3);
  EXPECT_FALSE(shortest_turn(p, one));
  EXPECT_FALSE(shortest_turn(one, p));
  EXPECT_FALSE(shortest_turn(p.leftCols(1), p.leftCols(1)));
}

TEST(HandleRotations, OfALineDoNotRollUnlessTheEditSaysIt) {
  const Matrix3Xd v = line(3), q = turn(Vector3d::UnitY(), 100) * v;
  const std::vector<int> one_group(3, 0);
  const Matrix3Xd fitted = handle_rotations(v, q, Matrix3Xd(3, 0), one_group);
  for (int l = 0; l < 3; ++l) {
    EXPECT_LT((fitted.col(l) - Vector3d(0, 100 * kDegree, 0)).norm(), 1e-9);
  }
  const Matrix3Xd asked = Vector3d(0.3, 0, 0).replicate(1, 3);
  EXPECT_EQ(handle_rotations(v, q, asked, one_group), asked);
}

// A rod along x, its vertices above the axis, and those of its end.
struct Rod {
  Shape shape = tube(40);
  std::vector<int> top, end_top, first_ring;

  Rod() {
    shape.N.resize(3, 0);
    for (int i = 0; i < shape.V.cols(); i += 12) {
      top.push_back(i);
      if (shape.V(0, i) > 0.7 * shape.V.row(0).maxCoeff()) end_top.push_back(i);
    }
    for (int i = 0; i < 12; ++i) first_ring.push_back(i);
  }
};

Handles free_handles(const std::vector<int>& moved, bool one_group) {
  Handles handles;
  handles.moved = moved;
  for (std::size_t l = 0; l < moved.size(); ++l) {
    handles.groups.push_back(one_group ? 0 : static_cast<int>(l));
  }
  return handles;
}

TEST(LineHandles, AFreeShapeTurnsWithItsLine) {
  const Rod rod;
  for (const bool one_group : {false, true}) {
    for (const double degrees : {60.0, 170.0, 180.0}) {
      const Matrix3d R = turn(Vector3d(0, 1, 1), degrees);
      EmbeddedDeformation deformer(rod.shape, preset_options());
      deformer.compile(free_handles(rod.top, one_group));
      const Report report = deformer.update(R * rod.shape.V(Eigen::all, rod.top));
      const double off = (deformer.deformed().V - R * rod.shape.V).cwiseAbs().maxCoeff();
      if (degrees < 180) {
        EXPECT_LT(off, 0.01) << degrees << " " << one_group;
      }
      EXPECT_EQ(report.inside_out, 0);
      EXPECT_LT(report.handle_max, 1e-3);
      EXPECT_LT(report.solve.iterations.size(), 5u) << degrees << " " << one_group;
    }
  }
}

TEST(LineHandles, TwoHandlesMayGoToTheOtherSide) {
  const Rod rod;
  const std::vector<int> ends{rod.top.front(), rod.top.back()};
  EmbeddedDeformation deformer(rod.shape, preset_options());
  deformer.compile(free_handles(ends, false));
  const Report report = deformer.update(-rod.shape.V(Eigen::all, ends));
  EXPECT_EQ(report.inside_out, 0);
  const Matrix3Xd& V = deformer.deformed().V;
  EXPECT_LT(
      (V.rightCols<12>().rowwise().maxCoeff() - V.rightCols<12>().rowwise().minCoeff()).maxCoeff(),
      1.1 * (rod.shape.V.row(1).maxCoeff() - rod.shape.V.row(1).minCoeff()));
}

// How far the end is rolled about its own axis, against the turn of its line [degree].
double roll_of_end(const Shape& rest, const Matrix3Xd& V, const Vector3d& turned) {
  const auto from = rest.V.rightCols<24>(), to = V.rightCols<24>();
  const Matrix3d R = nearest_rotation((to.colwise() - to.rowwise().mean()) *
                                      (from.colwise() - from.rowwise().mean()).transpose());
  const Eigen::AngleAxisd shortest(turned.norm(), turned.normalized());
  const Matrix3d off = R * shortest.toRotationMatrix().transpose();
  const Vector3d axis = shortest * Vector3d::UnitX();
  const Vector3d twice_sine(off(2, 1) - off(1, 2), off(0, 2) - off(2, 0), off(1, 0) - off(0, 1));
  return std::atan2(twice_sine.dot(axis), off.trace() - 1) / kDegree;
}

// The end of a rod that is fixed at the other end bends upwards.
Matrix3Xd bent(const Rod& rod, double degrees) {
  const Matrix3Xd v = rod.shape.V(Eigen::all, rod.end_top);
  const double length = rod.shape.V.row(0).maxCoeff();
  const double angle = std::max(degrees, 1e-6) * kDegree, radius = length / angle;
  const Vector3d end(radius * std::sin(angle), 0, radius * (1 - std::cos(angle)));
  return (turn(Vector3d(0, -1, 0), degrees) * (v.colwise() - Vector3d(length, 0, 0))).colwise() +
         end;
}

// A fixed part holds the roll. One solve finds the shape that many small steps lead to.
TEST(LineHandles, AtTheEndOfAFixedRodRollAsInSmallSteps) {
  const Rod rod;
  Handles handles = free_handles(rod.end_top, true);
  handles.fixed = rod.first_ring;
  for (const double degrees : {45.0, 90.0, 150.0}) {
    EmbeddedDeformation at_once(rod.shape, preset_options()), in_steps(rod.shape, preset_options());
    at_once.compile(handles);
    in_steps.compile(handles);
    at_once.update(bent(rod, degrees));
    for (int step = 1; step <= 15; ++step) in_steps.update(bent(rod, degrees * step / 15));
    const Matrix3Xd off = at_once.deformed().V - in_steps.deformed().V;
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 0.02) << degrees;
  }
}

TEST(LineHandles, OfAnAnimationRollAlikeFromFrameToFrame) {
  const Rod rod;
  Handles handles = free_handles(rod.end_top, true);
  handles.fixed = rod.first_ring;
  AnimatedDeformation deformer(rod.shape, preset_options());
  deformer.compile(handles);
  double before = 0;
  for (int frame = 0; frame <= 10; ++frame) {
    const double degrees = 15.0 * frame;
    deformer.update(rod.shape, bent(rod, degrees) - rod.shape.V(Eigen::all, rod.end_top));
    const Vector3d turned(0, -std::max(degrees, 1e-9) * kDegree, 0);
    const double roll = roll_of_end(rod.shape, deformer.deformed().V, turned);
    EXPECT_LT(std::abs(roll - before), 3) << degrees;
    before = roll;
  }
}

}  // namespace
}  // namespace deformlab::test
