#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "deformers/baselines/rbf_deformation.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<int> some_vertices(int n, int step) {
  std::vector<int> result;
  for (int i = 0; i < n; i += step) result.push_back(i);
  return result;
}

double farthest(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a - b).colwise().norm().maxCoeff();
}

TEST(Rbf, InterpolatesAnyDisplacementOfTheHandles) {
  const Shape shape = point_set(300);
  const std::vector<int> moved = some_vertices(300, 3);
  RbfDeformation deformer(shape);
  deformer.compile({{}, moved});
  const Eigen::Matrix3Xd targets = shape.V(Eigen::all, moved) + random_points(100, {1, 1, 1}, 7);
  const Report report = deformer.update(targets);
  EXPECT_LT(report.handle_max, 1e-10);
  EXPECT_LT(farthest(deformer.deformed().V(Eigen::all, moved), targets), 1e-10);
  EXPECT_EQ(deformer.centers().cols(), 100);
  EXPECT_THAT(report.notes, IsEmpty());
}

TEST(Rbf, ReproducesAffineMaps) {
  Eigen::Matrix3d A;
  A << 1, 0.5, -0.2, 0.3, 2, 0, -1, 0.1, 0.7;
  const Eigen::Vector3d t(5, -2, 1);
  const Shape shape = point_set(300);
  const Eigen::Matrix3Xd expected = (A * shape.V).colwise() + t;
  for (const int most : {4, 20, 1000}) {
    RbfOptions options;
    options.max_centers = most;
    RbfDeformation deformer(shape, options);
    const std::vector<int> moved = some_vertices(300, 5);
    deformer.compile({{}, moved});
    deformer.update(expected(Eigen::all, moved));
    EXPECT_LT(farthest(deformer.deformed().V, expected), 1e-9) << most;
  }
}

TEST(Rbf, NormalsFollowTheGradientOfTheDisplacement) {
  const Shape plane = bumpy_plane(40, 1, 0.05);
  RbfDeformation deformer(plane);
  const std::vector<int> moved = some_vertices(1600, 97);
  deformer.compile({{}, moved});
  const auto n = static_cast<int>(moved.size());
  deformer.update(plane.V(Eigen::all, moved) + 0.1 * random_points(n, {1, 1, 1}, 3));
  const Eigen::Matrix3Xd expected = vertex_normals(deformer.deformed());
  for (int i = 0; i < 1600; ++i) {
    const bool inside = i % 40 > 0 && i % 40 < 39 && i / 40 > 0 && i / 40 < 39;
    if (!inside) continue;  // where the mean of the triangles is one-sided
    EXPECT_GT(deformer.deformed().N.col(i).dot(expected.col(i)), 0.98) << i;
  }
}

TEST(Rbf, FewerCentresThanHandlesAreAFitAndSaidSo) {
  const Shape shape = point_set(300);
  const std::vector<int> moved = some_vertices(300, 3);
  const Eigen::Matrix3Xd targets =
      shape.V(Eigen::all, moved) + 0.1 * random_points(100, {1, 1, 1}, 7);
  double last = 1;
  for (const int most : {5, 20, 60, 100}) {
    RbfOptions options;
    options.max_centers = most;
    RbfDeformation deformer(shape, options);
    deformer.compile({{}, moved});
    const Report report = deformer.update(targets);
    EXPECT_EQ(deformer.centers().cols(), most);
    EXPECT_LT(report.handle_rms, last);  // more can only fit better
    EXPECT_EQ(report.notes.size(), most < 100 ? 1u : 0u);
    for (const auto& note : report.notes) EXPECT_THAT(note, HasSubstr("least squares"));
    last = report.handle_rms;
  }
  EXPECT_LT(last, 1e-10);
}

TEST(Rbf, KeepingTheBasisOrNotIsTheSame) {
  const Shape plane = bumpy_plane(40);
  Eigen::Matrix3Xd V[2];
  for (const int k : {0, 1}) {
    RbfOptions options;
    options.megabytes = 1000 * k;
    RbfDeformation deformer(plane, options);
    deformer.compile({{0, 1, 2, 40}, {1599, 1500}});
    deformer.update(plane.V(Eigen::all, std::vector<int>{1599, 1500}) * 1.5);
    V[k] = deformer.deformed().V;
  }
  EXPECT_LT(farthest(V[0], V[1]), 1e-13);
}

TEST(Rbf, HandlesThatSpanLessThanSpace) {
  const Shape plane = bumpy_plane(10, 1, 0);
  const struct {
    std::vector<int> moved;
    const char* note;
  } cases[] = {{{7}, "at one point"}, {{0, 3, 9}, "on a line"}, {{0, 9, 90, 99}, "in a plane"}};
  for (const auto& [moved, note] : cases) {
    RbfDeformation deformer(plane);
    deformer.compile({{}, moved});
    const Eigen::Vector3d t(1, 2, 3);
    const Report report = deformer.update(plane.V(Eigen::all, moved).colwise() + t);
    EXPECT_THAT(report.notes, Contains(HasSubstr(note)));
    EXPECT_LT(farthest(deformer.deformed().V, plane.V.colwise() + t), 1e-9) << note;
  }
}

TEST(Rbf, HandlesAtOnePointMoveByTheirMean) {
  Shape shape = point_set(50);
  shape.V.col(1) = shape.V.col(0);
  RbfDeformation deformer(shape);
  deformer.compile({{}, {0, 1, 20, 30, 40}});
  Eigen::Matrix3Xd targets = shape.V(Eigen::all, std::vector<int>{0, 1, 20, 30, 40});
  targets(2, 0) += 0.2;
  const Report report = deformer.update(targets);
  EXPECT_THAT(report.notes, Contains(HasSubstr("4 centres for 5 handles")));
  EXPECT_NEAR(report.handle_max, 0.1, 1e-9);
}

TEST(Rbf, OptionsOutOfRange) {
  const auto refused = [](int centers, int megabytes) -> std::string {
    return error_of([&] { RbfDeformation(point_set(10), {centers, megabytes}); });
  };
  EXPECT_THAT(refused(0, 1), HasSubstr("max_centers is 0"));
  EXPECT_THAT(refused(1000000, 1), HasSubstr("max_centers is 1000000"));
  EXPECT_THAT(refused(10, -1), HasSubstr("megabytes is -1"));
}

}  // namespace
}  // namespace deformlab::test
