#include "deformers/embedded/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/harmonic_start.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A closed rod along z, of length 2 and radius 0.2.
Shape rod(int sides = 24, int rings = 60) {
  Shape shape{Eigen::Matrix3Xd(3, sides * (rings + 1) + 2), {}, {}};
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      shape.V.col(j * sides + i) << 0.2 * std::cos(angle), 0.2 * std::sin(angle), 2.0 * j / rings;
    }
  }
  const int bottom = sides * (rings + 1), top = bottom + 1;
  shape.V.col(bottom).setZero();
  shape.V.col(top) << 0, 0, 2;
  for (int i = 0; i < sides; ++i) {
    const int k = (i + 1) % sides, last = sides * rings;
    for (int j = 0; j < rings; ++j) {
      shape.faces.push_back(
          {j * sides + i, j * sides + k, (j + 1) * sides + k, (j + 1) * sides + i});
    }
    shape.faces.push_back({k, i, bottom});
    shape.faces.push_back({last + i, last + k, top});
  }
  return shape;
}

double volume(const Shape& shape) {
  const Eigen::Matrix3Xi T = triangles(shape);
  double sum = 0;
  for (const auto t : T.colwise()) {
    sum +=
        shape.V.col(t[0]).dot(Eigen::Vector3d(shape.V.col(t[1])).cross(shape.V.col(t[2]).eval()));
  }
  return sum / 6;
}

// The lower end is fixed and the upper end turns about the axis of the rod.
struct Twist {
  Handles handles;
  Eigen::Matrix3Xd targets;

  Twist(const Shape& shape, double degrees, bool says_so = true) {
    for (int i = 0; i < shape.V.cols(); ++i) {
      if (shape.V(2, i) < 0.11) handles.fixed.push_back(i);
      if (shape.V(2, i) > 1.89) handles.moved.push_back(i);
    }
    const double angle = degrees * std::numbers::pi / 180;
    targets = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
              shape.V(Eigen::all, handles.moved);
    handles.groups.assign(handles.moved.size(), 0);
    if (!says_so) return;
    handles.rotations = Eigen::Vector3d(0, 0, angle).replicate(1, targets.cols());
  }
};

// The angle by which a ring of vertices has turned, less than a half turn.
double turn_of_ring(const Shape& rest, const Shape& deformed, int ring, int sides = 24) {
  double sine = 0, cosine = 0;
  for (int i = ring * sides; i < (ring + 1) * sides; ++i) {
    const auto p = rest.V.col(i), q = deformed.V.col(i);
    const double angle = std::atan2(q[1], q[0]) - std::atan2(p[1], p[0]);
    sine += std::sin(angle), cosine += std::cos(angle);
  }
  return std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

TEST(Presets, OfThePaperIsWhatThePaperSays) {
  const EmbeddedDeformationOptions paper = preset_options(Preset::kSumner2007);
  EXPECT_EQ(paper.graph.neighbors, 4);
  EXPECT_EQ(paper.graph.alpha, EdgeWeights::kUniform);
  EXPECT_EQ(paper.border, Border::kEliminate);
  EXPECT_TRUE(paper.energies.empty());  // the terms' own weights: 1, 10, 100
}

TEST(DefaultPreset, KeepsTheVolumeOfATwistedRod) {
  const Shape rest = rod();
  for (const double degrees : {150.0, 180.0}) {
    const Twist twist(rest, degrees);
    EmbeddedDeformation deformer(rest, preset_options());
    deformer.compile(twist.handles);
    const Report report = deformer.update(twist.targets);
    EXPECT_EQ(report.solve.status, Status::kConverged);
    EXPECT_LE(report.solve.iterations.size(), 12u);
    EXPECT_EQ(report.inside_out, 0);
    EXPECT_THAT(report.undone, IsEmpty());
    EXPECT_GT(volume(deformer.deformed()) / volume(rest), 0.87);
    EXPECT_LT(report.handle_max, 1e-3);
  }
}

TEST(DefaultPreset, TurnsTheWayThatIsAsked) {
  const Shape rest = rod();
  for (const double degrees : {270.0, -270.0, 300.0}) {
    const Twist twist(rest, degrees);
    EmbeddedDeformation deformer(rest, preset_options());
    deformer.compile(twist.handles);
    EXPECT_THAT(deformer.update(twist.targets).undone, IsEmpty());
    const double middle = turn_of_ring(rest, deformer.deformed(), 30);
    EXPECT_NEAR(std::remainder(middle - degrees / 2, 360), 0, 10);
  }
}

TEST(DefaultPreset, NodesInsideHoldAFullTurnOfACoarseMesh) {
  const Shape rest = rod(12, 30);
  const Twist twist(rest, 360);
  EmbeddedDeformation deformer(rest, preset_options());
  deformer.compile(twist.handles);
  EXPECT_THAT(deformer.update(twist.targets).undone, IsEmpty());
  EXPECT_NEAR(std::abs(turn_of_ring(rest, deformer.deformed(), 15, 12)), 180, 15);
}

TEST(DefaultPreset, NodesInsideHoldAFullTurn) {
  const Shape rest = rod();
  const Twist twist(rest, 360);
  EmbeddedDeformationOptions options = preset_options();
  EmbeddedDeformation automatic(rest, options);
  options.graph.interior = InteriorNodes::kOff;
  EmbeddedDeformation hollow(rest, options);
  for (EmbeddedDeformation* deformer : {&automatic, &hollow}) {
    deformer->compile(twist.handles);
    const Report report = deformer->update(twist.targets);
    EXPECT_EQ(report.undone.empty(), deformer == &automatic);
    EXPECT_LT(report.handle_max, 1e-3);
  }
  EXPECT_GT(automatic.graph().g.cols(), hollow.graph().g.cols());
  EXPECT_GT(volume(automatic.deformed()) / volume(rest), 0.75);
  EXPECT_NEAR(std::abs(turn_of_ring(rest, automatic.deformed(), 30)), 180, 10);
  EXPECT_NEAR(turn_of_ring(rest, hollow.deformed(), 30), 0, 10);
}

TEST(DefaultPreset, NodesInsideGoAgainForSmallerTurns) {
  const Shape rest = rod();
  EmbeddedDeformation deformer(rest, preset_options());
  Eigen::Index hollow = 0;
  for (const double degrees : {90.0, 300.0, 90.0}) {
    const Twist twist(rest, degrees);
    deformer.compile(twist.handles);
    if (hollow == 0) hollow = deformer.graph().g.cols();
    EXPECT_EQ(deformer.graph().g.cols() > hollow, degrees > 180);
    EXPECT_LT(deformer.update(twist.targets).handle_max, 1e-3);
  }
}

TEST(DefaultPreset, HandlesInTheMiddleNeedNoNodesInside) {
  const Shape rest = rod();
  Twist twist(rest, 300);
  for (int i = 0; i < rest.V.cols(); ++i) {
    if (std::abs(rest.V(2, i) - 1) > 0.01) continue;
    twist.handles.moved.push_back(i);
    twist.handles.groups.push_back(1);
  }
  const Eigen::Index before = twist.handles.rotations.cols();
  twist.handles.rotations.conservativeResize(3, std::ssize(twist.handles.moved));
  twist.handles.rotations.rightCols(twist.handles.rotations.cols() - before).colwise() =
      twist.handles.rotations.col(0) / 2;
  EmbeddedDeformationOptions options = preset_options();
  EmbeddedDeformation automatic(rest, options);
  automatic.compile(twist.handles);
  options.graph.interior = InteriorNodes::kOff;
  EmbeddedDeformation hollow(rest, options);
  hollow.compile(twist.handles);
  EXPECT_EQ(automatic.graph().g, hollow.graph().g);
}

TEST(InteriorNodes, AnOpenShapeHasNone) {
  Shape open = rod(12, 20);
  open.faces.pop_back();
  EmbeddedDeformationOptions options = preset_options();
  const Twist twist(open, 300);
  EmbeddedDeformation automatic(open, options);
  automatic.compile(twist.handles);
  EXPECT_LT(automatic.update(twist.targets).handle_max, 1e-2);
  options.graph.interior = InteriorNodes::kOn;
  EXPECT_THAT(error_of([&] { EmbeddedDeformation(open, options); }),
              AllOf(HasSubstr("graph.interior is on"), HasSubstr("closed surface"),
                    HasSubstr("interior: off")));
}

TEST(InteriorNodes, BothSolversHoldAFullTurn) {
  const Shape rest = rod(12, 30);
  const Twist twist(rest, 360);
  EmbeddedDeformationOptions options = preset_options();
  options.solver.epsilon = 1e-12;  // the minimum is flat
  EmbeddedDeformation ours(rest, options);
  options.solver.method = SolverMethod::kCeres;
  EmbeddedDeformation ceres(rest, options);
  for (EmbeddedDeformation* deformer : {&ours, &ceres}) {
    deformer->compile(twist.handles);
    EXPECT_THAT(deformer->update(twist.targets).undone, IsEmpty());
  }
  EXPECT_LT((ours.deformed().V - ceres.deformed().V).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(DefaultPreset, SaysThatATurnIsLost) {
  const Shape rest = rod();
  const Twist twist(rest, 720);
  EmbeddedDeformation deformer(rest, preset_options());
  deformer.compile(twist.handles);
  deformer.update(Eigen::Matrix3Xd(rest.V(Eigen::all, twist.handles.moved)));  // starts at rest
  const Report report = deformer.update(twist.targets);
  ASSERT_THAT(report.undone, SizeIs(1));
  EXPECT_THAT(report.undone[0], HasSubstr("720"));
}

TEST(DefaultPreset, FixedVerticesStayAndThoseBesideThemMove) {
  const Shape rest = bumpy_plane(41);
  Handles handles;
  for (int i = 0; i < rest.V.cols(); ++i) {
    if (rest.V(0, i) < 0.5) handles.fixed.push_back(i);
  }
  handles.moved = {41 * 41 - 1};
  EmbeddedDeformation deformer(rest, preset_options());
  deformer.compile(handles);
  deformer.update(rest.V.rightCols<1>() + Eigen::Vector3d(0, 0, 0.2));
  for (const int i : handles.fixed) EXPECT_EQ(deformer.deformed().V.col(i), rest.V.col(i));
  const int beside = 20 * 41 + 21;  // the first free column
  EXPECT_GT((deformer.deformed().V.col(beside) - rest.V.col(beside)).norm(), 1e-5);
}

TEST(DefaultPreset, OneHandleTranslatesTheShape) {
  const Shape rest = bumpy_plane(9);
  EmbeddedDeformation deformer(rest, preset_options());
  deformer.compile({.fixed = {}, .moved = {40}});
  const Eigen::Vector3d by(0.1, 0.2, 0.3);
  deformer.update(rest.V.col(40) + by);
  EXPECT_LT((deformer.deformed().V - (rest.V.colwise() + by)).norm(), 1e-9);
}

TEST(DefaultPreset, ChangingWhatIsFixedBuildsTheGraphAgain) {
  const Shape rest = bumpy_plane(61);
  std::vector<int> far_left, most;
  for (int i = 0; i < rest.V.cols(); ++i) {
    if (rest.V(0, i) < 0.1) far_left.push_back(i);
    if (rest.V(0, i) < 0.8) most.push_back(i);
  }
  const int corner = 61 * 61 - 1;
  EmbeddedDeformation deformer(rest, preset_options());
  deformer.compile({.fixed = far_left, .moved = {corner}});
  EXPECT_LT(deformer.graph().g.row(0).minCoeff(), 0.3);
  deformer.compile({.fixed = most, .moved = {corner}});
  EXPECT_GT(deformer.graph().g.row(0).minCoeff(), 0.4);
  const Report report = deformer.update(rest.V.col(corner) + Eigen::Vector3d(0, 0, 0.1));
  EXPECT_LT(report.handle_max, 1e-3);
}

TEST(DefaultPreset, BothSolversFindTheSameShape) {
  const Shape rest = rod(12, 20);
  const Twist twist(rest, 120);
  EmbeddedDeformationOptions options = preset_options();
  EmbeddedDeformation ours(rest, options);
  options.solver.method = SolverMethod::kCeres;
  EmbeddedDeformation ceres(rest, options);
  for (EmbeddedDeformation* deformer : {&ours, &ceres}) {
    deformer->compile(twist.handles);
    deformer->update(twist.targets);
  }
  EXPECT_LT((ours.deformed().V - ceres.deformed().V).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(HandleRotations, TargetsShowTheRotationAndTheEditTheTurns) {
  const Shape rest = rod(8, 4);
  for (const double degrees : {30.0, 170.0, 200.0, 270.0, 350.0}) {
    const Twist asked(rest, degrees), silent(rest, degrees, false);
    const Eigen::Matrix3Xd v = rest.V(Eigen::all, asked.handles.moved);
    const double told =
        handle_rotations(v, asked.targets, asked.handles.rotations, asked.handles.groups)(2, 0);
    EXPECT_NEAR(told * 180 / std::numbers::pi, degrees, 1e-9);
    const double fitted =
        handle_rotations(v, silent.targets, silent.handles.rotations, silent.handles.groups)
            .col(0)
            .norm();
    EXPECT_NEAR(fitted * 180 / std::numbers::pi, std::abs(std::remainder(degrees, 360)), 1e-6);
  }
}

TEST(HandleRotations, OfOneHandleIsUnknownUnlessTheEditSaysIt) {
  const Eigen::Matrix3Xd v = Eigen::Vector3d(1, 2, 3), q = Eigen::Vector3d(4, 5, 6);
  EXPECT_TRUE(handle_rotations(v, q, Eigen::Matrix3Xd(3, 0), std::vector<int>{0}).hasNaN());
  const Eigen::Matrix3Xd asked = Eigen::Vector3d(0, 0, 1);
  EXPECT_EQ(handle_rotations(v, q, asked, std::vector<int>{0}), asked);
}

}  // namespace
}  // namespace deformlab::test
