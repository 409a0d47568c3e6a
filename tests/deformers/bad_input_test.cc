#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "deformers/embedded/embedded_deformation.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

EmbeddedDeformationOptions with_nodes(int nodes) {
  EmbeddedDeformationOptions options;
  options.graph.nodes = nodes;
  return options;
}

class BadInput : public ::testing::Test {
 protected:
  std::string error_of_handles(const Handles& handles) {
    return error_of([&] { deformer_.compile(handles); });
  }
  std::string error_of_targets(const Eigen::Matrix3Xd& targets) {
    return error_of([&] { deformer_.update(targets); });
  }

  const Shape shape_ = bumpy_plane(10);  // 100 vertices
  EmbeddedDeformation deformer_{shape_, with_nodes(15)};
};

TEST_F(BadInput, HandleThatDoesNotExist) {
  for (const int i : {-1, 100}) {
    const std::string expected =
        "vertex " + std::to_string(i) + "; the shape has the vertices 0 to 99";
    EXPECT_THAT(error_of_handles({{i}, {}}), HasSubstr(expected));
    EXPECT_THAT(error_of_handles({{}, {3, i}}), HasSubstr(expected));
  }
}

TEST_F(BadInput, VertexFixedAndMoved) {
  EXPECT_THAT(error_of_handles({{1, 2, 3}, {9, 2}}), HasSubstr("vertex 2 is both fixed and moved"));
}

TEST_F(BadInput, WrongNumberOfTargets) {
  deformer_.compile({{}, {3, 4}});
  for (const int n : {0, 1, 3}) {
    EXPECT_THAT(error_of_targets(Eigen::Matrix3Xd::Zero(3, n)),
                HasSubstr(std::to_string(n) + " targets for 2 handles"));
  }
}

TEST_F(BadInput, TargetThatIsNotFinite) {
  deformer_.compile({{}, {3}});
  for (const double bad : {double(NAN), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(error_of_targets(Eigen::Vector3d(0, bad, 0)), HasSubstr("not finite"));
  }
  EXPECT_EQ(deformer_.deformed().V, shape_.V);
}

TEST_F(BadInput, LeavesTheHandlesThatWereThere) {
  deformer_.compile({{}, {3, 50, 99}});
  EXPECT_NE(error_of_handles({{}, {100}}), "");
  const Eigen::Matrix3Xd targets = shape_.V(Eigen::all, std::vector<int>{3, 50, 99});
  EXPECT_EQ(deformer_.update(targets).solve.status, Status::kConverged);
}

TEST_F(BadInput, TargetsBeyondAllBoundsFailWithoutTouchingTheState) {
  for (const SolverMethod method : {SolverMethod::kGaussNewton, SolverMethod::kCeres}) {
    EmbeddedDeformationOptions options = with_nodes(15);
    options.solver.method = method;
    EmbeddedDeformation deformer(shape_, options);
    deformer.compile({{}, {3, 50, 99}});
    const Report report = deformer.update(Eigen::Matrix3Xd::Constant(3, 3, 1e300));
    EXPECT_EQ(report.solve.status, Status::kFailed) << method;
    EXPECT_LT((deformer.deformed().V - shape_.V).cwiseAbs().maxCoeff(), 1e-14) << method;
  }
}

TEST_F(BadInput, OptionsOutOfRange) {
  const auto error_with = [&](auto&& change) {
    EmbeddedDeformationOptions options = with_nodes(15);
    change(options);
    return error_of([&] { EmbeddedDeformation(shape_, options); });
  };
  EXPECT_THAT(error_with([](auto& o) { o.energies["rotaton"] = 1; }), HasSubstr("'rotaton'"));
  EXPECT_THAT(error_with([](auto& o) { o.energies["rotation"] = -1; }),
              HasSubstr("energies.rotation"));
  EXPECT_THAT(error_with([](auto& o) { o.energies["rotation"] = NAN; }),
              HasSubstr("energies.rotation"));
  for (const char* unit : {"", "mean", "0", "-1", "1m", "nan", "inf"}) {
    EXPECT_THAT(error_with([&](auto& o) { o.length_unit = unit; }), HasSubstr("length_unit"))
        << unit;
  }
  EXPECT_THAT(error_with([](auto& o) { o.graph.nodes = 0; }), HasSubstr("graph.nodes"));
  EXPECT_THAT(error_with([](auto& o) { o.graph.neighbors = 0; }), HasSubstr("graph.neighbors"));
  EXPECT_THAT(error_with([](auto& o) { o.solver.epsilon = 0; }), HasSubstr("solver.epsilon is 0"));
  EXPECT_THAT(error_with([](auto& o) { o.solver.linear_solver = "cgnr"; }),
              HasSubstr("solver.linear_solver is 'cgnr'"));
  EXPECT_THAT(error_with([](auto& o) { o.losses["rotation"].scale = 0; }),
              HasSubstr("losses.rotation.scale is 0"));
  EXPECT_THAT(error_with([](auto& o) { o.transfer_threads = 0; }),
              HasSubstr("transfer_threads is 0; allowed: 1 to 1024"));
}

/// Lifts every tenth vertex. Expects a finite shape with the same numbers of vertices and normals
/// and the same faces.
Report lift(const Shape& shape, const EmbeddedDeformationOptions& options) {
  EmbeddedDeformation deformer(shape, options);
  Handles handles;
  for (int i = 0; i < shape.V.cols(); i += 10) handles.moved.push_back(i);
  deformer.compile(handles);
  const Eigen::Matrix3Xd rest = shape.V(Eigen::all, handles.moved);
  Report report = deformer.update(rest.colwise() + Eigen::Vector3d(0, 0, 0.2));
  EXPECT_EQ(deformer.deformed().V.cols(), shape.V.cols());
  EXPECT_EQ(deformer.deformed().N.cols(), shape.N.cols());
  EXPECT_EQ(deformer.deformed().faces, shape.faces);
  EXPECT_TRUE(deformer.deformed().V.allFinite());
  EXPECT_NE(report.solve.status, Status::kFailed) << report.solve.message;
  EXPECT_LT(report.handle_rms, 0.01);
  return report;
}

TEST(AnyShape, FewerNodesThanNeighborsIsARuleThatIsNoted) {
  for (const int m : {1, 2, 3, 4}) {
    const Report report = lift(bumpy_plane(10), with_nodes(m));
    EXPECT_THAT(report.notes, Contains(HasSubstr("fewer than neighbors + 1"))) << m;
  }
  EXPECT_THAT(lift(bumpy_plane(10), with_nodes(5)).notes,
              ::testing::Not(Contains(HasSubstr("fewer than"))));
}

TEST(AnyShape, PointSetsAndSoups) {
  lift(point_set(400), with_nodes(30));
  lift(soup(100), with_nodes(30));
}

TEST(AnyShape, CoincidentPoints) {
  const Shape plane = bumpy_plane(10);
  lift(side_by_side(plane, plane, {0, 0, 0}), with_nodes(20));
  Shape points = point_set(100);
  points.V.rightCols(50) = points.V.leftCols(50).eval();
  lift(points, with_nodes(20));
}

TEST(AnyShape, AllPointsAtOnePositionOrOnALine) {
  const Shape one{Eigen::Matrix3Xd::Ones(3, 10), Eigen::Matrix3Xd(3, 0), {}};
  lift(one, with_nodes(1));
  Shape line = point_set(50);
  line.V.bottomRows(2).setZero();
  lift(line, with_nodes(12));
}

TEST(AnyShape, TrianglesWithoutArea) {
  Shape plane = bumpy_plane(10);
  plane.faces.push_back({0, 0, 1});
  plane.faces.push_back({5, 5, 5});
  plane.faces.push_back({7});
  lift(plane, with_nodes(20));
}

}  // namespace
}  // namespace deformlab::test
