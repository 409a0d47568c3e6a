#include "deformers/arap_2d/arap_2d.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/errors.h"
#include "tests/support/samples.h"

// The deformer around the two steps, which takes handles and gives a shape and a report.
namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Triangulation& square() {
  static const Triangulation mesh = shaken_grid(9, 2);
  return mesh;
}

Arap2dOptions with(TwoStepMethod steps) {
  Arap2dOptions options;
  options.steps = steps;
  return options;
}

Handles corner_and_point() {
  Handles handles;
  handles.fixed = {0};
  handles.moved = {80};
  handles.points = Eigen::Vector3d(1.3, 1.6, 0);
  return handles;
}

Eigen::Matrix3Xd targets() {
  Eigen::Matrix3Xd result(3, 2);
  result.col(0) << square().V.col(80) + Eigen::Vector2d(0.5, -0.4), 0;
  result.col(1) << 1.1, 2, 0;
  return result;
}

TEST(Arap2d, MovesWhatIsMovedAndKeepsWhatIsFixed) {
  for (const TwoStepMethod steps : {TwoStepMethod::kClosedForm, TwoStepMethod::kGeneralSolver}) {
    Arap2d deformer(square(), {}, with(steps));
    deformer.compile(corner_and_point());
    const Report report = deformer.update(targets());
    EXPECT_EQ(report.solve.status, Status::kConverged);
    EXPECT_LT(report.handle_max, 1e-10);
    EXPECT_EQ(report.nodes, 81);
    EXPECT_EQ(report.inside_out, 0);
    EXPECT_GT(report.min_det_R, 0.2);
    const Eigen::Matrix3Xd& V = deformer.deformed().V;
    EXPECT_LT((V.col(0).head<2>() - square().V.col(0)).norm(), 1e-12);
    EXPECT_LT((V.col(80) - targets().col(0)).norm(), 1e-12);
    EXPECT_EQ(V.row(2).norm(), 0);
    EXPECT_EQ(deformer.deformed().faces.size(), 128u);
  }
}

TEST(Arap2d, BothWaysComeToOneShape) {
  for (const int refinements : {0, 2}) {
    Arap2dOptions one = with(TwoStepMethod::kClosedForm),
                  other = with(TwoStepMethod::kGeneralSolver);
    one.refinements = other.refinements = refinements;
    Arap2d closed_form(square(), {}, one), general(square(), {}, other);
    for (Arap2d* deformer : {&closed_form, &general}) {
      deformer->compile(corner_and_point());
      deformer->update(targets());
    }
    EXPECT_LT((closed_form.deformed().V - general.deformed().V).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((closed_form.intermediate() - general.intermediate()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((closed_form.fitted() - general.fitted()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Arap2d, TheResultDoesNotDependOnTheWay) {
  Arap2d dragged(square(), {}, {}), at_once(square(), {}, {});
  dragged.compile(corner_and_point());
  at_once.compile(corner_and_point());
  Eigen::Matrix3Xd rest(3, 2);
  rest << square().V.col(80), corner_and_point().points.topRows<2>(), 0, 0;
  for (int i = 0; i <= 10; ++i) dragged.update(rest + 0.1 * i * (targets() - rest));
  at_once.update(targets());
  EXPECT_LT((dragged.deformed().V - at_once.deformed().V).norm(), 1e-11);
}

TEST(Arap2d, AdaptsToHandlesThatAreAddedAndRemoved) {
  Arap2d deformer(square(), {}, {}), other(square(), {}, with(TwoStepMethod::kGeneralSolver));
  const int before = deformer.compilations(), of_other = other.compilations();
  Handles more = corner_and_point();
  more.moved = {8, 80};
  Eigen::Matrix3Xd to(3, 3);
  to << Eigen::Vector3d(square().V(0, 8), square().V(1, 8), 0), targets();
  for (Arap2d* each : {&deformer, &other}) {
    each->compile(corner_and_point());
    each->update(targets());
    each->compile(more);
    each->update(to);
  }
  EXPECT_LT((deformer.deformed().V - other.deformed().V).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(deformer.compilations(), before);
  EXPECT_EQ(other.compilations(), of_other + 2);
}

TEST(Arap2d, ResetsToRestAndKeepsItsHandles) {
  Arap2d deformer(square(), {}, {});
  deformer.compile(corner_and_point());
  const Report first = deformer.update(targets());
  const Eigen::Matrix3Xd V = deformer.deformed().V;
  deformer.reset();
  EXPECT_EQ(deformer.deformed().V.topRows<2>(), square().V);
  deformer.update(targets());
  EXPECT_EQ(deformer.deformed().V, V);
}

TEST(Arap2d, TakesPointsOnTheBoundaryAndAtCorners) {
  Handles handles;
  const Eigen::Vector2d a = square().V.col(0), b = square().V.col(1), c = square().V.col(40);
  handles.points.resize(3, 3);
  handles.points << a, 0.3 * a + 0.7 * b, c, 0, 0, 0;
  Arap2d deformer(square(), {}, {});
  deformer.compile(handles);
  Eigen::Matrix3Xd to = handles.points;
  to.col(2).x() += 1;
  EXPECT_LT(deformer.update(to).handle_max, 1e-12);
  EXPECT_LT((deformer.deformed().V.col(40).head<2>() - to.col(2).head<2>()).norm(), 1e-12);
}

TEST(Arap2d, SaysWhereAHandleOutsideCouldBe) {
  Arap2d deformer(square(), {}, {});
  Handles handles;
  handles.points = Eigen::Vector3d(1.5, -2, 0);
  EXPECT_THAT(error_of([&] { deformer.compile(handles); }),
              AllOf(HasSubstr("(1.5, -2)"), HasSubstr("outside"), HasSubstr("nearest")));
  handles.points.setConstant(std::nan(""));
  EXPECT_NE(error_of([&] { deformer.compile(handles); }), "");
}

TEST(Arap2d, RefusesBadHandlesTargetsAndOptions) {
  Arap2d deformer(square(), {}, {});
  EXPECT_THAT(error_of([&] { deformer.compile({.fixed = {}, .moved = {81}}); }), HasSubstr("81"));
  EXPECT_THAT(error_of([&] { deformer.compile({.fixed = {3}, .moved = {3}}); }), HasSubstr("both"));
  deformer.compile(corner_and_point());
  EXPECT_THAT(error_of([&] { deformer.update(Eigen::Matrix3Xd::Zero(3, 5)); }), HasSubstr("5"));
  Eigen::Matrix3Xd endless = targets();
  endless(0, 1) = INFINITY;
  EXPECT_THAT(error_of([&] { deformer.update(endless); }), HasSubstr("finite"));
  Arap2dOptions options;
  options.refinements = -1;
  EXPECT_THAT(error_of([&] { Arap2d(square(), {}, options); }), HasSubstr("-1"));
  options = with(TwoStepMethod::kGeneralSolver);
  options.solver.epsilon = 0;
  EXPECT_THAT(error_of([&] { Arap2d(square(), {}, options); }), HasSubstr("solver.epsilon is 0"));
}

TEST(Arap2d, TargetsTooFarAwayAreAFailureThatIsReported) {
  Arap2d deformer(square(), {}, {});
  deformer.compile(corner_and_point());
  deformer.update(targets());
  const Eigen::Matrix3Xd V = deformer.deformed().V;
  const Report report = deformer.update(4e307 * targets());
  EXPECT_EQ(report.solve.status, Status::kFailed);
  EXPECT_EQ(deformer.deformed().V, V);
  EXPECT_LT(deformer.update(targets()).handle_max, 1e-12);
}

}  // namespace
}  // namespace deformlab::test
