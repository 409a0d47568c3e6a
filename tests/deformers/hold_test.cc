#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/handles/satellites.h"
#include "deformers/embedded/presets.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

// What a handle can hold besides its position: an angle and a weight. And how stiff the shape is.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr int kLast = 108;  // the first vertex of the last ring of tube(10)

Handles moved(std::vector<int> vertices) {
  Handles handles;
  for (int i = 0; i < 12; ++i) handles.fixed.push_back(i);
  handles.moved = std::move(vertices);
  handles.groups.assign(handles.moved.size(), 0);
  return handles;
}

// How far the last ring has turned about the axis of the tube [degree].
double turn_of_end(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xd& rest) {
  Eigen::Vector2d sum(0, 0);
  for (int i = kLast; i < kLast + 12; ++i) {
    const double angle = std::atan2(V(2, i), V(1, i)) - std::atan2(rest(2, i), rest(1, i));
    sum += Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return std::atan2(sum.y(), sum.x()) * 180 / kPi;
}

TEST(HoldAngles, OneVertexTurnsItsSurroundings) {
  Shape shape = tube(10);
  shape.V.conservativeResize(3, 121);  // the middle of the end
  shape.V.col(120) << 4.5, 0, 0;
  for (int i = 0; i < 12; ++i) shape.faces.push_back({kLast + i, kLast + (i + 1) % 12, 120});
  shape.N.resize(3, 0);
  Handles handles = moved({120});
  handles.rotations = Eigen::Vector3d(40 * kPi / 180, 0, 0);
  for (const bool holds : {false, true}) {
    EmbeddedDeformationOptions options = preset_options();
    options.hold_angles = holds;
    EmbeddedDeformation deformer(shape, options);
    deformer.compile(handles);
    deformer.update(shape.V.col(120));
    EXPECT_NEAR(turn_of_end(deformer.deformed().V, shape.V), holds ? 40 : 0, 4);
  }
}

TEST(HoldAngles, SatellitesAreForHandlesOnALine) {
  Eigen::Matrix3Xd v(3, 6);
  v << 0, 1, 2, 0, 1, 0, 0, 0, 0, 5, 5, 6, 0, 0, 0, 0, 0, 0;
  Eigen::Matrix3Xd turns = Eigen::Vector3d(0, 0, kPi / 2).replicate(1, 6);
  const std::vector<int> groups{0, 0, 0, 1, 1, 1};
  const Satellites satellites = make_satellites(v, turns, groups, 0.5);
  EXPECT_EQ(satellites.count(), 12) << "the second group spans a plane";
  EXPECT_TRUE(satellites.arms.leftCols(4).rowwise().sum().isZero(1e-14));
  const Eigen::Matrix3d squares =
      satellites.arms.leftCols(4) * satellites.arms.leftCols(4).transpose();
  EXPECT_TRUE(squares.isApprox(Eigen::Matrix3d::Identity() / 3, 1e-14));
  const Eigen::Matrix3d quarter =
      Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(satellites.turned.isApprox(quarter * satellites.arms, 1e-14));
  turns.leftCols(3).setConstant(NAN);
  EXPECT_EQ(make_satellites(v, turns, groups, 0.5).count(), 0) << "nothing is said";
  EXPECT_EQ(make_satellites(v, Eigen::Matrix3Xd(3, 0), groups, 0.5).count(), 0);
}

TEST(HandleWeights, TheHeavierOfTwoHandlesWins) {
  const Shape shape = tube(10);
  Handles handles = moved({kLast, kLast + 1});
  Eigen::Matrix3Xd targets = shape.V(Eigen::all, handles.moved);
  targets(0, 0) += 0.5;
  targets(0, 1) -= 0.5;
  const auto missed = [&](double first, double second) {
    handles.weights = Eigen::Vector2d(first, second);
    EmbeddedDeformationOptions options;
    options.graph.nodes = 12;
    EmbeddedDeformation deformer(shape, options);
    deformer.compile(handles);
    deformer.update(targets);
    const Eigen::Matrix3Xd off = deformer.deformed().V(Eigen::all, handles.moved) - targets;
    return Eigen::RowVectorXd(off.colwise().norm());
  };
  const Eigen::RowVectorXd heavy_first = missed(100, 1), heavy_last = missed(1, 100);
  EXPECT_LT(heavy_first[0], 0.2 * heavy_first[1]);
  EXPECT_LT(heavy_last[1], 0.2 * heavy_last[0]);
}

TEST(Stiffness, AStiffPartKeepsItsShape) {
  const Shape shape = bumpy_plane(15, 1, 0);
  Handles handles;
  Eigen::VectorXd stiffness = Eigen::VectorXd::Ones(shape.V.cols());
  std::vector<int> part;
  for (int i = 0; i < shape.V.cols(); ++i) {
    if (shape.V(0, i) == 0) handles.fixed.push_back(i);
    if (shape.V(0, i) == 1) handles.moved.push_back(i);
    if (shape.V(0, i) > 0.3 && shape.V(0, i) < 0.7) part.push_back(i), stiffness[i] = 10'000;
  }
  Eigen::Matrix3Xd targets = shape.V(Eigen::all, handles.moved);
  targets.row(0).array() += 0.5;
  const auto stretch = [&](const Eigen::VectorXd& stiff) {
    EmbeddedDeformationOptions options;
    options.graph.nodes = 60;
    options.stiffness = stiff;
    EmbeddedDeformation deformer(shape, options);
    deformer.compile(handles);
    deformer.update(targets);
    const Eigen::VectorXd x = deformer.deformed().V.row(0)(part), rest = shape.V.row(0)(part);
    return (x.maxCoeff() - x.minCoeff()) / (rest.maxCoeff() - rest.minCoeff());
  };
  EXPECT_GT(stretch({}), 1.3);
  EXPECT_NEAR(stretch(stiffness), 1, 0.02);
  EXPECT_NEAR(stretch(Eigen::VectorXd::Ones(shape.V.cols())), stretch({}), 1e-12);
}

TEST(Stiffness, IsOnePositiveNumberForEachVertex) {
  const Shape shape = bumpy_plane(5);
  EmbeddedDeformationOptions options;
  options.stiffness = Eigen::VectorXd::Ones(24);
  EXPECT_THAT(error_of([&] { EmbeddedDeformation(shape, options); }),
              HasSubstr("24 numbers for 25"));
  options.stiffness = Eigen::VectorXd::Zero(25);
  EXPECT_THAT(error_of([&] { EmbeddedDeformation(shape, options); }), HasSubstr("above 0"));
}

}  // namespace
}  // namespace deformlab::test
