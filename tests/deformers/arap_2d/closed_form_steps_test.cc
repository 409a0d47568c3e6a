#include "deformers/arap_2d/closed_form_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <complex>

#include "tests/deformers/arap_2d/handle_cases.h"
#include "tests/support/heap_calls.h"

// The laws that the closed form keeps. general_steps_test.cc compares it with the general solvers.
namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ClosedFormSteps, MeetsItsTargets) {
  const Triangulation mesh = square();
  for (const auto& [name, points] : handle_cases(mesh)) {
    ClosedFormSteps steps(mesh, ones(mesh));
    steps.compile(points);
    const Eigen::Matrix2Xd targets = moved(mesh, points);
    steps.update(targets);
    for (int i = 0; i < std::ssize(points); ++i) {
      EXPECT_LT((points[i].at(steps.positions()) - targets.col(i)).norm(), 1e-11) << name;
    }
  }
}

TEST(ClosedFormSteps, ARigidMotionOfTheHandlesMovesAllRigidly) {
  const Triangulation mesh = square();
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(2.5).toRotationMatrix();
  const Eigen::Vector2d c(7, -4);
  for (const auto& [name, points] : handle_cases(mesh)) {
    ClosedFormSteps steps(mesh, painted(mesh, 1e4));
    steps.compile(points);
    steps.update((Q * at_rest(mesh, points)).colwise() + c);
    const Eigen::Matrix2Xd expected = (Q * mesh.V).colwise() + c;
    EXPECT_LT((steps.intermediate() - expected).cwiseAbs().maxCoeff(), 1e-8) << name;
    EXPECT_LT((steps.positions() - expected).cwiseAbs().maxCoeff(), 1e-8) << name;
  }
}

TEST(ClosedFormSteps, AMotionOfEverythingAndAnotherUnitChangeNothingElse) {
  const Triangulation mesh = square();
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  const Eigen::Vector2d c(300, -20);
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto map = [&](const Eigen::Matrix2Xd& points) -> Eigen::Matrix2Xd {
      return unit * ((Q * points).colwise() + c);
    };
    for (const auto& [name, points] : handle_cases(mesh)) {
      ClosedFormSteps steps(mesh, ones(mesh)), other({map(mesh.V), mesh.F}, ones(mesh));
      steps.compile(points);
      other.compile(points);
      const Eigen::Matrix2Xd targets = moved(mesh, points);
      steps.update(targets);
      other.update(map(targets));
      EXPECT_LT((other.positions() - map(steps.positions())).cwiseAbs().maxCoeff(), 1e-9 * unit)
          << name << " " << unit;
    }
  }
}

// With two handles, step one is exactly a similarity (section 7; Figure 19 shows the consequence).
TEST(ClosedFormSteps, StepOneOfTwoHandlesIsASimilarity) {
  const Triangulation mesh = square();
  const std::vector<BarycentricPoint> points{BarycentricPoint::at_vertex(0),
                                             BarycentricPoint::at_vertex(120)};
  ClosedFormSteps steps(mesh, ones(mesh));
  steps.compile(points);
  const Eigen::Matrix2Xd p = at_rest(mesh, points), q = moved(mesh, points);
  steps.update(q);
  const auto z = [](const Eigen::Vector2d& v) { return std::complex(v.x(), v.y()); };
  const std::complex<double> s = z(q.col(1) - q.col(0)) / z(p.col(1) - p.col(0));
  const Eigen::Matrix2Xd result = steps.intermediate();
  for (Eigen::Index i = 0; i < mesh.V.cols(); ++i) {
    const std::complex<double> expected = z(q.col(0)) + s * z(mesh.V.col(i) - p.col(0));
    EXPECT_LT(std::abs(z(result.col(i)) - expected), 1e-11);
  }
}

TEST(ClosedFormSteps, WithoutAHandleItRestsAndOneMovesItAsItIs) {
  const Triangulation mesh = square();
  ClosedFormSteps steps(mesh, ones(mesh));
  steps.compile({});
  steps.update(Eigen::Matrix2Xd(2, 0));
  EXPECT_EQ(steps.positions(), mesh.V);
  EXPECT_THAT(steps.notes(), ::testing::ElementsAre(HasSubstr("has no handle")));
  const BarycentricPoint point{mesh.F.col(60), {0.2, 0.3, 0.5}};
  const std::vector<std::vector<BarycentricPoint>> one_point{
      {BarycentricPoint::at_vertex(40)}, {point}, {point, point}};
  for (const auto& points : one_point) {
    steps.compile(points);
    steps.update(at_rest(mesh, points).colwise() + Eigen::Vector2d(1, 2));
    const Eigen::Matrix2Xd expected = mesh.V.colwise() + Eigen::Vector2d(1, 2);
    EXPECT_LT((steps.positions() - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((steps.intermediate() - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_THAT(steps.notes(), ::testing::ElementsAre(HasSubstr("one point only")));
  }
}

TEST(ClosedFormSteps, HandlesThatCollapseToAPointComeBack) {
  const Triangulation mesh = square();
  for (const auto& [name, points] : handle_cases(mesh)) {
    ClosedFormSteps steps(mesh, ones(mesh));
    steps.compile(points);
    const Eigen::Matrix2Xd from = at_rest(mesh, points);
    const Eigen::Vector2d to = from.rowwise().mean();
    for (const double t : {0.5, 0.9, 1.0, 1.0, 0.7, 0.0}) {
      steps.update(((1 - t) * from).colwise() + t * to);
      EXPECT_TRUE(steps.positions().allFinite()) << name;
      EXPECT_TRUE(steps.fitted().allFinite()) << name;
    }
    EXPECT_LT((steps.positions() - mesh.V).cwiseAbs().maxCoeff(), 1e-9) << name;
  }
}

TEST(ClosedFormSteps, HandlesInOnePlaceWithSeveralTargetsAreMetOnTheMean) {
  const Triangulation mesh = square();
  const BarycentricPoint point{mesh.F.col(60), {0.2, 0.3, 0.5}};
  const std::vector<BarycentricPoint> points{point, point, BarycentricPoint::at_vertex(0)};
  ClosedFormSteps steps(mesh, ones(mesh));
  steps.compile(points);
  Eigen::Matrix2Xd targets = at_rest(mesh, points);
  targets.col(0) += Eigen::Vector2d(1, 0);
  targets.col(1) += Eigen::Vector2d(0, 1);
  steps.update(targets);
  const Eigen::Vector2d mean = targets.leftCols<2>().rowwise().mean();
  EXPECT_LT((point.at(steps.positions()) - mean).norm(), 1e-11);
}

TEST(ClosedFormSteps, APartWithoutAHandleStays) {
  const Triangulation mesh = two_squares();
  const Eigen::Index n = mesh.V.cols() / 2;
  const std::vector<BarycentricPoint> points{BarycentricPoint::at_vertex(3),
                                             BarycentricPoint::at_vertex(100)};
  ClosedFormSteps steps(mesh, ones(mesh));
  steps.compile(points);
  steps.update(moved(mesh, points));
  EXPECT_EQ(steps.positions().rightCols(n), mesh.V.rightCols(n));
  EXPECT_GT((steps.positions() - mesh.V).leftCols(n).norm(), 1);
  EXPECT_THAT(steps.notes(), ::testing::ElementsAre(HasSubstr("the first is vertex 121")));
}

TEST(ClosedFormSteps, PartsDoNotFeelEachOther) {
  const Triangulation mesh = two_squares();
  const std::vector<BarycentricPoint> left{BarycentricPoint::at_vertex(3),
                                           BarycentricPoint::at_vertex(100)};
  std::vector<BarycentricPoint> both = left;
  for (const int v : {130, 180, 230}) both.push_back(BarycentricPoint::at_vertex(v));
  ClosedFormSteps one(mesh, ones(mesh)), two(mesh, ones(mesh));
  one.compile(left);
  two.compile(both);
  one.update(moved(mesh, left));
  two.update(moved(mesh, both));
  EXPECT_THAT(two.notes(), IsEmpty());
  EXPECT_EQ(one.positions().leftCols(121), two.positions().leftCols(121));
}

TEST(ClosedFormSteps, PaintedTrianglesKeepTheirForm) {
  const Triangulation mesh = square();
  const auto [name, points] = handle_cases(mesh)[1];
  std::vector<double> energy;
  Triangulation part = mesh;
  part.F = mesh.F.middleCols<12>(20);
  for (const double weight : {1.0, 1e4}) {
    ClosedFormSteps steps(mesh, painted(mesh, weight));
    steps.compile(points);
    steps.update(moved(mesh, points));
    energy.push_back(arap_energy(part, steps.positions()));
  }
  EXPECT_LT(energy[1], 1e-3 * energy[0]);
}

TEST(ClosedFormSteps, AnUpdateDoesNotAllocate) {
  const Triangulation mesh = square();
  for (const auto& [name, points] : handle_cases(mesh)) {
    ClosedFormSteps steps(mesh, ones(mesh), 2);
    steps.compile(points);
    const Eigen::Matrix2Xd targets = moved(mesh, points);
    steps.update(targets);
    const long before = heap_calls;
    steps.update(targets);
    EXPECT_EQ(heap_calls - before, 0) << name;
  }
  // Neither does the first one after handles have changed.
  ClosedFormSteps adapting(mesh, ones(mesh));
  for (const auto& [name, points] : handle_cases(mesh)) {
    adapting.compile(points);
    const Eigen::Matrix2Xd targets = moved(mesh, points);
    const long calls = heap_calls;
    adapting.update(targets);
    EXPECT_EQ(heap_calls - calls, 0) << name;
  }
  const long before = heap_calls;
  const std::vector<double> numbers(100);
  EXPECT_GE(heap_calls - before, 1);  // they are counted
}

}  // namespace
}  // namespace deformlab::test
