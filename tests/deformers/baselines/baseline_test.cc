#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "deformers/baselines/cgal_arap.h"
#include "deformers/baselines/primo_deformation.h"
#include "deformers/baselines/rbf_deformation.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

struct Method {
  std::string name;
  bool of_surfaces;  // it deforms surfaces; otherwise it deforms space
  std::function<std::unique_ptr<Deformer>(const Shape&)> make;
};

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

Method arap(CgalArapVariant variant) {
  return {"Arap_" + std::string(name_of(variant)), true, [variant](const Shape& shape) {
            CgalArapOptions options;
            options.variant = variant;
            options.iterations = 2000;
            options.tolerance = 1e-8;
            return std::make_unique<CgalArap>(shape, options);
          }};
}

std::vector<Method> methods() {
  const auto primo = [](const Shape& shape) { return std::make_unique<PrimoDeformation>(shape); };
  const auto rbf = [](const Shape& shape) { return std::make_unique<RbfDeformation>(shape); };
  return {{"Primo", true, primo},
          {"Rbf", false, rbf},
          arap(CgalArapVariant::kSpokesAndRims),
          arap(CgalArapVariant::kOriginal),
          arap(CgalArapVariant::kSmoothRotations)};
}

class Baseline : public ::testing::TestWithParam<Method> {
 protected:
  static std::unique_ptr<Deformer> make(const Shape& shape) { return GetParam().make(shape); }
};
INSTANTIATE_TEST_SUITE_P(Every, Baseline, ::testing::ValuesIn(methods()),
                         [](const auto& test) { return test.param.name; });

// Handles of an n×n plane: the vertices in its first `left` columns are fixed, those in its last
// `right` columns are moved.
Handles strips(int n, int left, int right) {
  Handles handles;
  for (int i = 0; i < n * n; ++i) {
    if (i % n < left) handles.fixed.push_back(i);
    if (i % n >= n - right) handles.moved.push_back(i);
  }
  return handles;
}

Eigen::Matrix3Xd at(const Shape& shape, const std::vector<int>& vertices) {
  return shape.V(Eigen::all, vertices);
}

Eigen::Matrix3Xd lifted(const Shape& shape, const Handles& handles, double height) {
  return at(shape, handles.moved).colwise() + Eigen::Vector3d(0, 0, height);
}

double farthest(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a - b).colwise().norm().maxCoeff();
}

TEST_P(Baseline, ARigidMotionOfTheHandlesIsOneOfEverything) {
  const Shape plane = bumpy_plane(12);
  Handles handles = strips(12, 2, 2);
  handles.moved.insert(handles.moved.end(), handles.fixed.begin(), handles.fixed.end());
  handles.fixed.clear();
  const Eigen::AngleAxisd R(0.6, Eigen::Vector3d(1, 2, -1).normalized());
  const Eigen::Vector3d t(3, -1, 2);
  const std::unique_ptr<Deformer> deformer = make(plane);
  deformer->compile(handles);
  const Eigen::Matrix3Xd expected = (R.toRotationMatrix() * plane.V).colwise() + t;
  const Report report = deformer->update(expected(Eigen::all, handles.moved));
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_LT(farthest(deformer->deformed().V, expected), 1e-6);
  EXPECT_LT(farthest(deformer->deformed().N, R.toRotationMatrix() * plane.N), 1e-5);
  EXPECT_LT(report.handle_max, 1e-8);
}

TEST_P(Baseline, AtRestNothingMoves) {
  const Shape plane = bumpy_plane(12);
  const std::unique_ptr<Deformer> deformer = make(plane);
  const Handles handles = strips(12, 2, 2);
  deformer->compile(handles);
  const Report report = deformer->update(at(plane, handles.moved));
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_LT(farthest(deformer->deformed().V, plane.V), 1e-12);
  EXPECT_LT(farthest(deformer->deformed().N, plane.N), 1e-9);
  EXPECT_LT(report.solve.final_cost, 1e-20);
}

TEST_P(Baseline, WithoutHandlesNothingMoves) {
  const Shape plane = bumpy_plane(12);
  const std::unique_ptr<Deformer> deformer = make(plane);
  for (int k = 0; k < 2; ++k) {
    const Report report = deformer->update(Eigen::Matrix3Xd(3, 0));
    EXPECT_EQ(report.solve.status, Status::kConverged);
    EXPECT_THAT(report.notes, Contains(HasSubstr("stay")));
    EXPECT_LT(farthest(deformer->deformed().V, plane.V), 1e-14);
    deformer->compile({});
  }
}

TEST_P(Baseline, FewHandlesThatMoveAlikeAreATranslation) {
  const Shape plane = bumpy_plane(12);
  const Eigen::Vector3d t(0.3, -5, 1);
  for (const std::vector<int>& moved : {std::vector{40}, {40, 100}, {0, 5, 100}}) {
    const std::unique_ptr<Deformer> deformer = make(plane);
    deformer->compile({{}, moved});
    const Report report = deformer->update(at(plane, moved).colwise() + t);
    EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
    EXPECT_LT(farthest(deformer->deformed().V, plane.V.colwise() + t), 1e-6) << moved.size();
  }
}

TEST_P(Baseline, KeepsWhatIsFixedAndMeetsTheTargets) {
  const Shape plane = bumpy_plane(12);
  const std::unique_ptr<Deformer> deformer = make(plane);
  const Handles handles = strips(12, 2, 2);
  deformer->compile(handles);
  const Eigen::Matrix3Xd targets = lifted(plane, handles, 0.5);
  const Report report = deformer->update(targets);
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_EQ(at(deformer->deformed(), handles.fixed), at(plane, handles.fixed));
  EXPECT_LT(farthest(at(deformer->deformed(), handles.moved), targets), 1e-9);
  EXPECT_LT(report.handle_max, 1e-9);
  EXPECT_LE(report.handle_rms, report.handle_max);
  EXPECT_EQ(deformer->deformed().faces, plane.faces);
  EXPECT_LT((deformer->deformed().N.colwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
  EXPECT_GT(report.seconds.at("solve"), 0);
  deformer->reset();
  EXPECT_EQ(deformer->deformed().V, plane.V);
  EXPECT_EQ(deformer->deformed().N, plane.N);
}

TEST_P(Baseline, DoesNotDependOnTheUnit) {
  const Shape metres = bumpy_plane(12);
  Shape millimetres = metres;
  millimetres.V *= 1000;
  const Handles handles = strips(12, 2, 1);
  const auto deformed = [&](const Shape& shape) -> Eigen::Matrix3Xd {
    const std::unique_ptr<Deformer> deformer = make(shape);
    deformer->compile(handles);
    const double side = shape.V.row(0).maxCoeff();
    deformer->update(lifted(shape, handles, 0.5 * side));
    return deformer->deformed().V / side;
  };
  EXPECT_LT(farthest(deformed(metres), deformed(millimetres)), 1e-8);
}

TEST_P(Baseline, GivesTheSameBitsTwiceAndAfterAReset) {
  const Shape plane = bumpy_plane(12);
  const Handles handles = strips(12, 2, 1);
  const auto one = make(plane), two = make(plane);
  for (Deformer* deformer : {one.get(), two.get()}) {
    deformer->compile(handles);
    deformer->update(lifted(plane, handles, 0.4));
  }
  EXPECT_EQ(one->deformed().V, two->deformed().V);
  two->reset();
  two->update(lifted(plane, handles, 0.4));
  EXPECT_EQ(one->deformed().V, two->deformed().V);
}

TEST_P(Baseline, OtherHandlesContinueFromWhereTheLastEnded) {
  const Shape plane = bumpy_plane(12);
  const std::unique_ptr<Deformer> deformer = make(plane);
  Handles handles = strips(12, 2, 2);
  deformer->compile(handles);
  deformer->update(lifted(plane, handles, 0.3));
  handles = strips(12, 2, 1);
  deformer->compile(handles);
  const Report report = deformer->update(lifted(plane, handles, 0.3));
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_LT(report.handle_max, 1e-5);  // PriMo pulls a line of vertices by weights
  // Back at rest, the shape is as before.
  deformer->update(at(plane, handles.moved));
  EXPECT_LT(farthest(deformer->deformed().V, plane.V), 1e-4);
}

TEST_P(Baseline, PartsWithoutAHandleStay) {
  const Shape two = side_by_side(bumpy_plane(12), bumpy_plane(12), {0, 0, 1});
  const std::unique_ptr<Deformer> deformer = make(two);
  const Handles handles = strips(12, 2, 2);
  deformer->compile(handles);
  const Report report = deformer->update(lifted(two, handles, 0.5));
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_LT(report.handle_max, 1e-9);
  if (!GetParam().of_surfaces) return;  // space has one part
  EXPECT_THAT(report.notes, Contains(HasSubstr("without a handle, which stay where they are: 1")));
  EXPECT_LT(farthest(deformer->deformed().V.rightCols(144), two.V.rightCols(144)), 1e-12);
}

TEST_P(Baseline, EveryVertexMayBeAHandle) {
  const Shape plane = bumpy_plane(6);
  const std::unique_ptr<Deformer> deformer = make(plane);
  Handles handles = strips(6, 0, 6);
  deformer->compile(handles);
  const Report report = deformer->update(lifted(plane, handles, 0.5));
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_LT(report.handle_max, 1e-12);
  std::swap(handles.fixed, handles.moved);
  deformer->reset();
  deformer->compile(handles);
  EXPECT_EQ(deformer->update(Eigen::Matrix3Xd(3, 0)).solve.status, Status::kConverged);
  EXPECT_EQ(deformer->deformed().V, plane.V);
}

TEST_P(Baseline, VerticesInNoTriangleMoveAsHandlesOnly) {
  if (!GetParam().of_surfaces) return;
  Shape plane = bumpy_plane(6);
  plane.N.resize(3, 0);
  plane.V.conservativeResize(3, 38);
  plane.V.rightCols(2) << 5, 6, 5, 6, 5, 6;
  const std::unique_ptr<Deformer> deformer = make(plane);
  Handles handles = strips(6, 2, 1);
  handles.moved.push_back(36);
  deformer->compile(handles);
  const Report report = deformer->update(lifted(plane, handles, 0.2));
  EXPECT_THAT(report.notes, Contains(HasSubstr("vertices in no triangle")));
  EXPECT_EQ(deformer->deformed().V.col(36), Eigen::Vector3d(5, 5, 5.2));
  EXPECT_EQ(deformer->deformed().V.col(37), plane.V.col(37));
}

TEST_P(Baseline, PointSetsAreForSpaceOnly) {
  const Shape points = point_set(60);
  if (GetParam().of_surfaces) {
    EXPECT_THAT(error_of([&] { make(points); }),
                AllOf(HasSubstr("no triangles"), HasSubstr("use embedded deformation")));
    return;
  }
  const std::unique_ptr<Deformer> deformer = make(points);
  const Handles handles{{0, 1, 2, 3}, {4, 5}};
  deformer->compile(handles);
  EXPECT_LT(deformer->update(lifted(points, handles, 0.5)).handle_max, 1e-9);
}

TEST_P(Baseline, BadHandlesAndTargetsLeaveAllAsItWas) {
  const Shape plane = bumpy_plane(10);
  const std::unique_ptr<Deformer> deformer = make(plane);
  const Handles handles = strips(10, 2, 2);
  deformer->compile(handles);
  EXPECT_THAT(error_of([&] { deformer->compile({{}, {100}}); }), HasSubstr("vertex 100"));
  EXPECT_THAT(error_of([&] { deformer->compile({{3}, {3}}); }), HasSubstr("both fixed and moved"));
  EXPECT_THAT(error_of([&] { deformer->compile({{}, {3, 3}}); }), HasSubstr("moved twice"));
  EXPECT_THAT(error_of([&] { deformer->update(Eigen::Matrix3Xd::Zero(3, 9)); }),
              HasSubstr("9 targets for 20 handles"));
  Eigen::Matrix3Xd targets = lifted(plane, handles, 0.1);
  targets(1, 3) = NAN;
  EXPECT_THAT(error_of([&] { deformer->update(targets); }), HasSubstr("not finite"));
  EXPECT_EQ(deformer->deformed().V, plane.V);
  EXPECT_LT(deformer->update(lifted(plane, handles, 0.1)).handle_max, 1e-9);
}

TEST_P(Baseline, TargetsBeyondAllBoundsFailWithoutTouchingTheState) {
  const Shape plane = bumpy_plane(10);
  const std::unique_ptr<Deformer> deformer = make(plane);
  const Handles handles = strips(10, 2, 2);
  deformer->compile(handles);
  for (const double far : {1e160, 1e300}) {
    const Report report = deformer->update(Eigen::Matrix3Xd::Constant(3, 20, far));
    EXPECT_EQ(report.solve.status, Status::kFailed);
    EXPECT_NE(report.solve.message, "");
    EXPECT_TRUE(deformer->deformed().V == plane.V);
  }
  EXPECT_LT(deformer->update(lifted(plane, handles, 0.1)).handle_max, 1e-9);
}

TEST_P(Baseline, HandlesThatAreNoVerticesAreForSpaceOnly) {
  Handles handles;
  handles.points = Eigen::Matrix3Xd::Constant(3, 2, 0.25);
  const std::unique_ptr<Deformer> deformer = make(bumpy_plane(10));
  const std::string error = error_of([&] { deformer->compile(handles); });
  EXPECT_EQ(error.empty(), !GetParam().of_surfaces);
  EXPECT_THAT(error, HasSubstr(GetParam().of_surfaces ? "2 handles are no vertices" : ""));
}

TEST_P(Baseline, TrianglesOfNoAreaDoNoHarm) {
  // One of two such triangles is among the handles. The corners of each lie on a line.
  Shape plane = bumpy_plane(12);
  plane.N.resize(3, 0);
  for (auto& face : plane.faces) {
    if (face[0] == 0 || face[0] == 65) face.pop_back();
  }
  const auto squash = [&](int a) {
    plane.V.col(a + 1) = (plane.V.col(a) + plane.V.col(a + 13)) / 2;
  };
  squash(0);
  squash(65);
  if (GetParam().name.starts_with("Arap")) {
    EXPECT_THAT(error_of([&] { make(plane); }),
                AllOf(HasSubstr("vertices 0, 1 and 13 has no area"), HasSubstr("repair the mesh")));
    return;
  }
  const std::unique_ptr<Deformer> deformer = make(plane);
  Handles handles = strips(12, 2, 2);
  deformer->compile(handles);
  Report report = deformer->update(lifted(plane, handles, 0.2));
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_LT(report.handle_max, 1e-9);
  EXPECT_LT(farthest(deformer->deformed().V, plane.V), 0.3);

  handles.moved.insert(handles.moved.end(), handles.fixed.begin(), handles.fixed.end());
  handles.fixed.clear();
  deformer->reset();
  deformer->compile(handles);
  const Eigen::Matrix3Xd expected =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix() * plane.V;
  report = deformer->update(expected(Eigen::all, handles.moved));
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_LT(report.solve.final_cost, 1e-9);
  EXPECT_LT(farthest(deformer->deformed().V, expected), 1e-6);
}

TEST_P(Baseline, ShapesThatCannotBeUsed) {
  EXPECT_NE(error_of([&] { make(Shape{}); }), "");
  Shape broken = bumpy_plane(5);
  broken.V(2, 7) = INFINITY;
  EXPECT_THAT(error_of([&] { make(broken); }), HasSubstr("vertex 7"));
  broken = bumpy_plane(5);
  broken.faces.push_back({0, 1, 25});
  EXPECT_THAT(error_of([&] { make(broken); }), HasSubstr("vertex 25"));
}

}  // namespace
}  // namespace deformlab::test
