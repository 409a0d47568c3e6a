#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformers/baselines/primo_deformation.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// A flat strip of columns × rows vertices, 2 long and 0.2 wide.
Shape strip(int columns, int rows) {
  Shape shape;
  shape.V.resize(3, columns * rows);
  for (int i = 0; i < columns * rows; ++i) {
    const int x = i % columns, y = i / columns;
    shape.V.col(i) << 2.0 * x / (columns - 1), 0.2 * y / (rows - 1), 0;
  }
  for (int y = 0; y + 1 < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const int a = y * columns + x;
      shape.faces.push_back({a, a + 1, a + 1 + columns, a + columns});
    }
  }
  return shape;
}

double mean_edge_error(const Shape& rest, const Eigen::Matrix3Xd& V) {
  double sum = 0;
  const Eigen::Matrix3Xi T = triangles(rest);
  for (const auto t : T.colwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      sum += std::abs((V.col(a) - V.col(b)).norm() / (rest.V.col(a) - rest.V.col(b)).norm() - 1);
    }
  }
  return sum / static_cast<double>(T.size());
}

// The position of v after the strip is bent into a quarter of a circle.
Eigen::Vector3d bent(const Eigen::Vector3d& v) {
  const double radius = 4 / std::numbers::pi, angle = v.x() / radius;
  return {radius * std::sin(angle), v.y(), radius * (1 - std::cos(angle))};
}

// Deforms the strip by handles at both ends, whose targets lie on a quarter of a circle.
Eigen::Matrix3Xd bend(const Shape& shape, int columns, const PrimoOptions& options = {}) {
  Handles handles;
  const int at_end = (columns - 1) / 10 + 1;
  for (int i = 0; i < shape.V.cols(); ++i) {
    const int x = i % columns;
    if (x < at_end || x >= columns - at_end) handles.moved.push_back(i);
  }
  PrimoDeformation deformer(shape, options);
  deformer.compile(handles);
  Eigen::Matrix3Xd targets(3, handles.targets());
  for (int l = 0; l < targets.cols(); ++l) targets.col(l) = bent(shape.V.col(handles.moved[l]));
  const Report report = deformer.update(targets);
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_LE(report.solve.iterations.size(), 12u);
  return deformer.deformed().V;
}

TEST(Primo, BendsAStripToTheArcAndKeepsItsEdges) {
  const Shape shape = strip(41, 5);
  const Eigen::Matrix3Xd V = bend(shape, 41);
  EXPECT_LT(mean_edge_error(shape, V), 0.002);
  for (int i = 0; i < V.cols(); ++i) {
    EXPECT_LT((V.col(i) - bent(shape.V.col(i))).norm(), 0.01) << i;
  }
}

TEST(Primo, BendsAlikeAtAnotherResolution) {
  // The middle of a plane whose right edge is lifted; its left one is fixed.
  const auto middle = [](int n) -> Eigen::Vector3d {
    const Shape plane = bumpy_plane(n, 1, 0);
    Handles handles;
    for (int i = 0; i < n * n; ++i) {
      if (plane.V(0, i) < 0.11) handles.fixed.push_back(i);
      if (plane.V(0, i) > 0.89) handles.moved.push_back(i);
    }
    PrimoDeformation deformer(plane);
    deformer.compile(handles);
    Eigen::Matrix3Xd targets = plane.V(Eigen::all, handles.moved);
    targets.row(2).array() += 0.3;
    deformer.update(targets);
    return deformer.deformed().V.col((n * n - 1) / 2 - (n - 1) / 5);
  };
  const Eigen::Vector3d coarse = middle(21), fine = middle(41);
  EXPECT_LT((coarse - fine).norm(), 0.01);
  EXPECT_GT(fine.z(), 0.05);
}

TEST(Primo, ConvergesInAFewStepsAtAnyResolution) {
  for (const int n : {21, 41, 81}) {
    const Shape plane = bumpy_plane(n);
    Handles handles;
    for (int i = 0; i < n * n; ++i) {
      if (plane.V(0, i) < 0.06) handles.fixed.push_back(i);
      if (plane.V(0, i) > 0.94) handles.moved.push_back(i);
    }
    PrimoDeformation deformer(plane);
    deformer.compile(handles);
    Eigen::Matrix3Xd targets = plane.V(Eigen::all, handles.moved);
    targets.row(2).array() += 0.5;
    const Report report = deformer.update(targets);
    EXPECT_EQ(report.solve.status, Status::kConverged) << n;
    EXPECT_LE(report.solve.iterations.size(), 8u) << n;
    const auto& steps = report.solve.iterations;
    for (std::size_t k = 1; k < steps.size(); ++k) {
      EXPECT_LE(steps[k].cost, steps[k - 1].cost * (1 + 1e-12)) << n;
    }
    EXPECT_LT(mean_edge_error(plane, deformer.deformed().V), 0.08) << n;
  }
}

TEST(Primo, HigherPrismsBendLess) {
  // One end of a strip is lifted. The same bend leaves more energy in joints of higher prisms.
  const Shape shape = strip(41, 5);
  double last = 0;
  for (const double height : {0.01, 0.05, 0.2}) {
    PrimoOptions options;
    options.height = height;
    PrimoDeformation deformer(shape, options);
    deformer.compile({{0, 1, 41, 42}, {39, 40, 80, 81}});
    Eigen::Matrix3Xd targets = shape.V(Eigen::all, std::vector<int>{39, 40, 80, 81});
    targets.row(2).array() += 0.3;
    const Report report = deformer.update(targets);
    EXPECT_GT(report.solve.final_cost, last) << height;
    last = report.solve.final_cost;
  }
}

TEST(Primo, TheSlopeIsThatOfTheEnergy) {
  const Shape plane = bumpy_plane(6);
  const PrismLayer prisms = make_prisms(plane.V, triangles(plane), 0.1);
  const auto m = static_cast<int>(prisms.T.cols());
  std::vector<char> fixed(m, 0);
  fixed[3] = 1;
  const Eigen::Vector3d p = plane.V.col(prisms.T(0, 10));
  PrismEquations equations(prisms, {{10, 0, 2.0, p, p + Eigen::Vector3d(0, 0.1, 0.2)}}, fixed);
  const auto velocities = [&](unsigned seed) {
    Eigen::MatrixXd result(6, m);
    result << random_points(m, {1, 1, 1}, seed), random_points(m, {1, 1, 1}, seed + 1);
    result.array() -= 0.5;
    result.col(3).setZero();
    return result;
  };
  RigidMotions motions = RigidMotions::at_rest(prisms), a = motions, b = motions;
  move(RigidMotions(motions), velocities(1), 0.3, motions);
  equations.linearize(motions);
  for (const unsigned seed : {10u, 20u, 30u}) {
    const Eigen::MatrixXd v = velocities(seed);
    constexpr double kStep = 1e-5;
    move(motions, v, kStep, a);
    move(motions, v, -kStep, b);
    const double slope = (equations.energy(a) - equations.energy(b)) / (2 * kStep);
    EXPECT_NEAR(2 * equations.slope(v), slope, 1e-6 * std::abs(slope));
  }
}

TEST(Primo, TheStepIsThatOfTheSecondDerivative) {
  // Near a minimum a full step ends close to it: the error decreases quadratically.
  const Shape plane = bumpy_plane(6);
  const PrismLayer prisms = make_prisms(plane.V, triangles(plane), 0.1);
  const auto m = static_cast<int>(prisms.T.cols());
  std::vector<char> fixed(m, 0);
  fixed[0] = 1;
  PrismEquations equations(prisms, {}, fixed);
  Eigen::MatrixXd v(6, m);
  v << random_points(m, {1, 1, 1}, 1), 0.1 * random_points(m, {1, 1, 1}, 2);
  v.col(0).setZero();
  RigidMotions motions = RigidMotions::at_rest(prisms), next = motions;
  move(RigidMotions(motions), v, 1e-3, motions);
  const double start = equations.energy(motions);
  equations.linearize(motions);
  ASSERT_TRUE(equations.solve(true, 1e-12, v));
  move(motions, v, 1, next);
  EXPECT_LT(equations.energy(next), 1e-4 * start);
}

TEST(Primo, AVertexMayBeAHandleWithoutATriangle) {
  const Shape plane = bumpy_plane(12);
  PrimoDeformation deformer(plane);
  deformer.compile({{0, 1, 2, 3, 12, 13, 14, 15}, {143}});
  const Eigen::Vector3d target = plane.V.col(143) + Eigen::Vector3d(0, 0, 0.2);
  const Report report = deformer.update(target);
  EXPECT_EQ(report.solve.status, Status::kConverged) << report.solve.message;
  EXPECT_LT(report.handle_max, 0.005);
}

TEST(Primo, TakesSoupsAndSurfacesThatAreNoManifold) {
  Shape shape = bumpy_plane(10);
  shape.faces.push_back({44, 45, 90});
  shape.faces.push_back({0, 0, 1});
  shape.N.resize(3, 0);
  PrimoDeformation deformer(shape);
  deformer.compile({{0, 1, 10, 11}, {88, 89, 98, 99}});
  const Eigen::Matrix3Xd targets =
      shape.V(Eigen::all, std::vector<int>{88, 89, 98, 99}).colwise() + Eigen::Vector3d(0, 0, 0.2);
  EXPECT_EQ(deformer.update(targets).solve.status, Status::kConverged);

  const Shape triangles = soup(40);
  PrimoDeformation each(triangles);
  each.compile({{}, {30}});
  const Report report = each.update(triangles.V.col(30) + Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(report.notes, Contains(HasSubstr("at one point only")));
  Eigen::Matrix3Xd expected = triangles.V;
  expected.middleCols<3>(30).row(0).array() += 1;
  EXPECT_LT((each.deformed().V - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Primo, OptionsOutOfRange) {
  const auto refused = [](auto&& change) -> std::string {
    PrimoOptions options;
    change(options);
    return error_of([&] { PrimoDeformation(bumpy_plane(5), options); });
  };
  for (const double bad : {0.0, -1.0, 1e9, double(NAN)}) {
    EXPECT_THAT(refused([&](auto& o) { o.height = bad; }), HasSubstr("height is")) << bad;
  }
  EXPECT_THAT(refused([](auto& o) { o.handle_weight = 0; }), HasSubstr("handle_weight is 0"));
  EXPECT_THAT(refused([](auto& o) { o.epsilon = 0; }), HasSubstr("epsilon is 0"));
  EXPECT_THAT(refused([](auto& o) { o.max_iterations = 0; }), HasSubstr("max_iterations is 0"));
}

}  // namespace
}  // namespace deformlab::test
