#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "deformers/embedded/embedded_deformation.h"
#include "deformers/embedded/presets.h"
#include "geometry/core/error.h"
#include "tests/support/shapes.h"

// Embedded deformation with d = 2: the same terms, six unknowns a node.
namespace deformlab::test {
namespace {

EmbeddedDeformationOptions in_the_plane(const char* linear_solver) {
  EmbeddedDeformationOptions options;
  options.dimension = 2;
  options.graph.nodes = 30;
  options.solver = {.linear_solver = linear_solver, .epsilon = 1e-14};
  return options;
}

// Three places, none of them a vertex.
Handles three_places() {
  Handles handles;
  handles.points.resize(3, 3);
  handles.points << 0.123, 0.871, 0.5, 0.2, 0.3, 0.777, 0, 0, 0;
  return handles;
}

TEST(InThePlane, HandlesAtAnyPlaceCarryTheShapeRigidly) {
  const Shape shape = bumpy_plane(20, 1, 0);
  const Handles handles = three_places();
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).matrix();
  const Eigen::Vector3d c(0.3, -0.2, 0);
  for (const char* linear_solver : {"cholmod", "eigen_ldlt", "kronecker_cg"}) {
    EmbeddedDeformation deformer(shape, in_the_plane(linear_solver));
    deformer.compile(handles);
    const Report report = deformer.update((Q * handles.points).colwise() + c);
    EXPECT_EQ(report.solve.status, Status::kConverged) << linear_solver;
    EXPECT_EQ(report.solve.unknowns, 6 * 30);
    const Eigen::Matrix3Xd expected = (Q * shape.V).colwise() + c;
    EXPECT_LT((deformer.deformed().V - expected).cwiseAbs().maxCoeff(), 1e-6) << linear_solver;
  }
}

TEST(InThePlane, BothSolversEndInOneMinimum) {
  const Shape shape = bumpy_plane(20, 1, 0);
  const Handles handles = three_places();
  Eigen::Matrix3Xd targets = handles.points;
  targets.col(2) += Eigen::Vector3d(0.1, 0.2, 0);
  EmbeddedDeformationOptions options = in_the_plane("auto");
  std::vector<double> costs;
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    options.solver.method = method;
    EmbeddedDeformation deformer(shape, options);
    deformer.compile(handles);
    costs.push_back(deformer.update(targets).solve.final_cost);
  }
  EXPECT_NEAR(costs[0], costs[1], 1e-9 * costs[0]);
}

TEST(InThePlane, AShapeThatIsNotFlatIsRefused) {
  EXPECT_THROW(EmbeddedDeformation(bumpy_plane(10), in_the_plane("auto")), InputError);
  EmbeddedDeformationOptions options = in_the_plane("auto");
  options.dimension = 4;
  EXPECT_THROW(EmbeddedDeformation(bumpy_plane(10, 1, 0), options), InputError);
}

TEST(InThePlane, AMotionAlongZIsRefused) {
  EmbeddedDeformation deformer(bumpy_plane(20, 1, 0), in_the_plane("auto"));
  deformer.compile(three_places());
  Eigen::Matrix3Xd targets = three_places().points;
  targets(2, 1) = 0.3;
  EXPECT_THROW(deformer.update(targets), OptionError);
}

TEST(InThePlane, HandlesOnALineHoldTheRotation) {
  const Shape shape = bumpy_plane(20, 1, 0);
  Handles handles = three_places();
  handles.points = handles.points.leftCols(2).eval();
  const Eigen::Matrix3d half_turn =
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()).matrix();
  EmbeddedDeformationOptions options = preset_options();
  options.dimension = 2;
  EmbeddedDeformation deformer(shape, options);
  deformer.compile(handles);
  const Report report = deformer.update(half_turn * handles.points);
  EXPECT_THAT(report.notes, ::testing::Not(::testing::Contains(::testing::HasSubstr("pinned"))));
  EXPECT_LT((deformer.deformed().V - half_turn * shape.V).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace deformlab::test
