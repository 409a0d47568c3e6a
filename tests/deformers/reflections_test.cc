#include "deformers/embedded/reflections.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformers/embedded/embedded_deformation.h"
#include "geometry/core/error.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

struct Strip {
  Shape shape;
  Handles handles;
  Eigen::Matrix3Xd targets;  // of its right end, at rest
};

/// 4 long and 0.5 wide, with bumps of this height; its left end is fixed, its right end moved.
Strip strip(double bumps = 0.02) {
  constexpr int nx = 81, ny = 11, held = 6;
  Strip result;
  Shape& shape = result.shape;
  shape.V.resize(3, nx * ny);
  for (int i = 0; i < nx * ny; ++i) {
    const int column = i % nx, row = i / nx;
    const double x = 4.0 * column / (nx - 1), y = 0.5 * row / (ny - 1);
    shape.V.col(i) << x, y, bumps * std::sin(8 * x) * std::sin(12 * y);
    if (i % nx < held) result.handles.fixed.push_back(i);
    if (i % nx >= nx - held) result.handles.moved.push_back(i);
  }
  for (int i = 0; i + nx < nx * ny; ++i) {
    if (i % nx < nx - 1) shape.faces.push_back({i, i + 1, i + nx + 1, i + nx});
  }
  result.targets = shape.V(Eigen::all, result.handles.moved);
  return result;
}

Report deform(const Strip& strip, Reflections reflections, int nodes = 150,
              SolverMethod method = SolverMethod::kGaussNewton, int dimension = 3) {
  EmbeddedDeformationOptions options;
  options.dimension = dimension;
  options.graph.nodes = nodes;
  options.reflections = reflections;
  options.solver.method = method;
  options.solver.max_iterations = 300;  // folds that open take up to some hundred
  EmbeddedDeformation deformation(strip.shape, options);
  deformation.compile(strip.handles);
  return deformation.update(strip.targets);
}

/// Its right end is turned about its long axis in one shot.
Report twist(double degrees, Reflections reflections, double bumps = 0.02) {
  Strip twisted = strip(bumps);
  const Eigen::Vector3d centre = twisted.targets.rowwise().mean();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitX())
          .toRotationMatrix();
  twisted.targets = ((R * (twisted.targets.colwise() - centre)).colwise() + centre).eval();
  return deform(twisted, reflections);
}

/// It is compressed to a third of its length in one shot, and folds.
Strip crushed(double bumps = 0.02) {
  Strip result = strip(bumps);
  result.targets.row(0).array() -= 4.0 * 2 / 3;
  return result;
}

class Twists : public ::testing::TestWithParam<double> {};

TEST_P(Twists, AreReportedWhereTheyTurnNodesInsideOut) {
  const Report report = twist(GetParam(), Reflections::kReport);
  EXPECT_GT(report.inside_out, 0);
  EXPECT_LT(report.min_det_R, -0.9);
  EXPECT_THAT(report.notes, Contains(HasSubstr("reflections=repair")));
}

TEST_P(Twists, AreCured) {
  const Report broken = twist(GetParam(), Reflections::kReport),
               report = twist(GetParam(), Reflections::kRepair);
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_GT(report.min_det_R, 0.5);
  EXPECT_LT(report.solve.final_cost, broken.solve.final_cost);
  EXPECT_THAT(report.notes, Contains(HasSubstr("turned back")));
}

INSTANTIATE_TEST_SUITE_P(Degrees, Twists, ::testing::Values(150, 170, 180));

class Folds : public ::testing::TestWithParam<int> {};

// A fold is what F is least at: it stays away only while the term that keeps it away is there.
TEST_P(Folds, AreCured) {
  const Report broken = deform(crushed(), Reflections::kReport, GetParam());
  const Report report = deform(crushed(), Reflections::kRepair, GetParam());
  EXPECT_GT(broken.inside_out, 0);
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_GT(report.min_det_R, 0);
  EXPECT_GT(report.solve.cost_by_term.at("orientation"), 0);
  EXPECT_LT(report.solve.final_cost, 1.1 * broken.solve.final_cost);
  EXPECT_THAT(report.notes, Contains(HasSubstr("of the term orientation")));
}

INSTANTIATE_TEST_SUITE_P(Nodes, Folds, ::testing::Values(60, 100, 150));

TEST(Reflections, OfAFoldAreCuredByCeresAlike) {
  const Report ours = deform(crushed(), Reflections::kRepair, 60);
  const Report report = deform(crushed(), Reflections::kRepair, 60, SolverMethod::kCeres);
  EXPECT_EQ(report.solve.method, "ceres");
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_NEAR(report.solve.final_cost, ours.solve.final_cost, 1e-2 * ours.solve.final_cost);
}

// In the plane no strip can bulge out of it.
TEST(Reflections, OfAFoldInThePlaneAreCured) {
  const Report broken =
      deform(crushed(0), Reflections::kReport, 150, SolverMethod::kGaussNewton, 2);
  const Report report =
      deform(crushed(0), Reflections::kRepair, 150, SolverMethod::kGaussNewton, 2);
  EXPECT_GT(broken.inside_out, 0);
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_EQ(report.inside_out, 0);
}

// Turned by exactly 180°, a flat strip has no reason to leave its plane, where it would only
// shrink.
TEST(Reflections, OfAFlatStripThatIsTurnedOverAreCured) {
  const Report broken = twist(180, Reflections::kReport, 0),
               report = twist(180, Reflections::kRepair, 0);
  EXPECT_GT(broken.inside_out, 0);
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_GT(report.min_det_R, 0.4);
  EXPECT_LT(report.solve.final_cost, broken.solve.final_cost);
}

// The next update starts from the repaired state: what it repairs has to come out alike.
TEST(Reflections, StayCuredInTheUpdatesThatFollow) {
  const Strip strip = crushed();
  EmbeddedDeformationOptions options;
  options.graph.nodes = 150;
  options.reflections = Reflections::kRepair;
  EmbeddedDeformation deformation(strip.shape, options);
  deformation.compile(strip.handles);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(deformation.update(strip.targets).inside_out, 0) << i;
}

// Every vertex is a handle, and their targets are the mirrored shape: nothing gives way.
TEST(Reflections, ThatHandlesAskForStayAndAreSaid) {
  const Shape shape = tube(8);
  const auto mirrored = [&](Reflections reflections) {
    EmbeddedDeformationOptions options;
    options.graph.nodes = 20;
    options.reflections = reflections;
    options.energies["constraint"] = 1e12;
    EmbeddedDeformation deformation(shape, options);
    Handles handles;
    for (int i = 0; i < shape.V.cols(); ++i) handles.moved.push_back(i);
    deformation.compile(handles);
    const Report report =
        deformation.update(Eigen::Vector3d(-1, 1, 1).asDiagonal() * Eigen::Matrix3Xd(shape.V));
    return std::pair(report, deformation.deformed().V);
  };
  const auto [report, V] = mirrored(Reflections::kRepair);
  const auto [same, same_V] = mirrored(Reflections::kReport);
  EXPECT_GT(report.inside_out, 0);
  EXPECT_EQ(report.inside_out, same.inside_out);
  EXPECT_EQ(V, same_V);
  EXPECT_THAT(report.notes, Contains(HasSubstr("could not be turned back")));
  EXPECT_THAT(report.notes, Not(Contains(HasSubstr("set reflections=repair"))));
}

TEST(Reflections, AreNoneWhereTheEditIsMild) {
  const Report report = twist(40, Reflections::kRepair), same = twist(40, Reflections::kReport);
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_EQ(report.solve.final_cost, same.solve.final_cost);
}

}  // namespace
}  // namespace deformlab::test
