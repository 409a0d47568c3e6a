#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "deformers/embedded/embedded_deformation.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

EmbeddedDeformationOptions rigid(SolverMethod method = SolverMethod::kGaussNewton) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = 30;
  options.rotation_model = RotationModel::kRigid;
  options.solver = {.method = method, .epsilon = 1e-12, .max_iterations = 300};
  return options;
}

double from_rotation(const Transformations& X) {
  double most = 0;
  for (Eigen::Index j = 0; j < X.cols() / 4; ++j) {
    const Eigen::Matrix3d R = X.middleCols<3>(4 * j);
    most = std::max(most, (R.transpose() * R - Eigen::Matrix3d::Identity()).norm());
  }
  return most;
}

TEST(RotationModel, RigidReproducesARigidMotion) {
  const Shape shape = tube(20);
  const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  const Eigen::Matrix3Xd V = (Q * shape.V).colwise() + Eigen::Vector3d(2, -1, 3);
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    EmbeddedDeformation deformer(shape, rigid(method));
    Handles handles;
    for (int i = 0; i < shape.V.cols(); i += 3) handles.moved.push_back(i);
    deformer.compile(handles);
    const Report report = deformer.update(V(Eigen::all, handles.moved));
    EXPECT_EQ(report.solve.unknowns, 6 * 30) << method;
    EXPECT_LT((deformer.deformed().V - V).cwiseAbs().maxCoeff(), 1e-6) << method;
    EXPECT_LT(from_rotation(deformer.transformations()), 1e-13) << method;
  }
}

TEST(RotationModel, BothSolversEndInOneMinimum) {
  const Shape shape = bumpy_plane(25);
  Handles handles;
  for (int i = 0; i < shape.V.cols(); ++i) {
    (i % 25 < 2 ? handles.fixed : handles.moved).push_back(i);
    if (i % 25 >= 2 && i % 25 < 23) handles.moved.pop_back();
  }
  Eigen::Matrix3Xd targets = shape.V(Eigen::all, handles.moved);
  targets.row(2).array() += 0.3 * bounding_box_diagonal(shape.V);
  Eigen::Matrix3Xd results[2];
  for (int s = 0; s < 2; ++s) {
    EmbeddedDeformation deformer(shape,
                                 rigid(s == 0 ? SolverMethod::kGaussNewton : SolverMethod::kCeres));
    deformer.compile(handles);
    EXPECT_GT(deformer.update(targets).solve.final_cost, 1e-3);
    EXPECT_LT(from_rotation(deformer.transformations()), 1e-13);
    results[s] = deformer.deformed().V;
  }
  EXPECT_LT((results[0] - results[1]).cwiseAbs().maxCoeff(), 1e-4 * bounding_box_diagonal(shape.V));
}

TEST(RotationModel, RigidNodesAreFactored) {
  const Shape shape = tube(20);
  EmbeddedDeformation deformer(shape, rigid());
  deformer.compile({.fixed = {0, 1, 2}, .moved = {static_cast<int>(shape.V.cols()) - 1}});
  Eigen::Matrix3Xd target = shape.V.rightCols<1>();
  target(1, 0) += 0.2;
  const Report report = deformer.update(target);
  EXPECT_EQ(report.solve.linear_solver, "cholmod");
  EXPECT_EQ(report.solve.choice, "no term is Kronecker");
}

TEST(RotationModel, RigidNodesFollowADragInSmallStepsPastHalfATurn) {
  Shape shape = bumpy_plane(25);
  shape.V.row(1) *= 0.2;  // a strip, which can be twisted without being stretched much
  Handles handles;
  for (int i = 0; i < shape.V.cols(); ++i) {
    if (i % 25 < 2) handles.fixed.push_back(i);
    if (i % 25 >= 23) handles.moved.push_back(i);
  }
  EmbeddedDeformation deformer(shape, rigid());
  deformer.compile(handles);
  const Eigen::Matrix3Xd V = shape.V(Eigen::all, handles.moved);
  const Eigen::Vector3d center = V.rowwise().mean();
  for (int degrees = 10; degrees <= 200; degrees += 10) {
    const double angle = degrees * 3.14159265358979 / 180;
    const Eigen::Matrix3d Q = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).matrix();
    const Report report = deformer.update((Q * (V.colwise() - center)).colwise() + center);
    EXPECT_EQ(report.solve.status, Status::kConverged) << degrees << report.solve.message;
    EXPECT_LT(report.handle_rms, 0.02 * bounding_box_diagonal(shape.V)) << degrees;
  }
}

void expect_refused(const EmbeddedDeformationOptions& options, const std::string& said) {
  EXPECT_THAT(error_of([&] { const EmbeddedDeformation deformer(tube(20), options); }),
              ::testing::HasSubstr(said));
}

TEST(RotationModel, RefusesWhatDoesNotGoWithIt) {
  EmbeddedDeformationOptions options = rigid();
  options.solver.linear_solver = "kronecker_cg";
  expect_refused(options, "none is Kronecker; use auto");
  options = rigid();
  options.energies["orientation"] = 1;
  expect_refused(options, "energies.orientation is 1");
  options.energies = {{"rotation", 5}, {"orientation", 0}, {"smoothness", 1}};
  EmbeddedDeformation(tube(20), options);
}

TEST(RotationModel, RigidIsForSpace) {
  EmbeddedDeformationOptions options = rigid();
  options.dimension = 2;
  const Shape flat = [] {
    Shape shape = bumpy_plane(10);
    shape.V.row(2).setZero();
    return shape;
  }();
  EXPECT_THROW(EmbeddedDeformation(flat, options), InputError);
}

}  // namespace
}  // namespace deformlab::test
