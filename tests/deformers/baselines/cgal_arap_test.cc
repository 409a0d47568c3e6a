#include "deformers/baselines/cgal_arap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "deformers/baselines/manifold.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

// The left column of a plane fixed, the right one lifted.
Report lift(CgalArap& deformer, const Shape& plane, int n, double height) {
  Handles handles;
  for (int y = 0; y < n; ++y) {
    handles.fixed.push_back(y * n);
    handles.moved.push_back(y * n + n - 1);
  }
  deformer.compile(handles);
  return deformer.update(plane.V(Eigen::all, handles.moved).colwise() +
                         Eigen::Vector3d(0, 0, height));
}

TEST(SpokesAndRims, CostNothingUnderARigidMotion) {
  const Shape plane = bumpy_plane(8);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(2, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  const SpokesAndRims state = spokes_and_rims(plane.V, R * plane.V, triangles(plane));
  EXPECT_LT(state.energy, 1e-24 * state.scale);
  for (Eigen::Index i = 0; i < 64; ++i) {
    EXPECT_LT((state.R.middleCols<3>(3 * i) - R).norm(), 1e-6) << i;
  }
}

TEST(SpokesAndRims, CostTwelveTimesTheAreaOfAScaledPlane) {
  // Σ cot α_e ‖p_e‖² is four times a triangle's area, and each of its corners counts it.
  const Shape plane = bumpy_plane(8, 1, 0);
  const SpokesAndRims state = spokes_and_rims(plane.V, 1.5 * plane.V, triangles(plane));
  EXPECT_NEAR(state.energy, 12 * 0.25, 1e-12);
}

TEST(CgalArap, StopsByTheChangeOfTheEnergy) {
  const Shape plane = bumpy_plane(15);
  CgalArap deformer(plane);
  const Report report = lift(deformer, plane, 15, 0.5);
  ASSERT_EQ(report.solve.status, Status::kConverged);
  const auto& steps = report.solve.iterations;
  ASSERT_GE(steps.size(), 3u);
  for (std::size_t k = 1; k < steps.size(); ++k) {
    EXPECT_LE(steps[k].cost, steps[k - 1].cost);
    const bool small = steps[k - 1].cost - steps[k].cost < 1e-4 * steps[k].cost;
    EXPECT_EQ(small, k + 1 == steps.size()) << k;
  }
  EXPECT_EQ(report.solve.final_cost, steps.back().cost);
  EXPECT_EQ(report.handle_max, 0);
}

TEST(CgalArap, SaysWhenItsIterationsAreUsedUp) {
  const Shape plane = bumpy_plane(15);
  CgalArapOptions options;
  options.iterations = 2;
  CgalArap deformer(plane, options);
  const Report report = lift(deformer, plane, 15, 0.5);
  EXPECT_EQ(report.solve.status, Status::kMaxIterations);
  EXPECT_EQ(report.solve.iterations.size(), 2u);
}

TEST(CgalArap, NeedsAManifoldAndNamesWhereItIsNone) {
  Shape fins = bumpy_plane(10);
  fins.faces.push_back({44, 45, 90});
  EXPECT_THAT(error_of([&] { CgalArap{fins}; }),
              HasSubstr("the edge between vertices 44 and 45 has more than two triangles"));
}

TEST(CgalArap, OptionsOutOfRange) {
  const auto refused = [](auto&& change) {
    CgalArapOptions options;
    change(options);
    return error_of([&] { CgalArap(bumpy_plane(5), options); });
  };
  EXPECT_THAT(refused([](auto& o) { o.iterations = 0; }), HasSubstr("iterations is 0"));
  for (const double bad : {0.0, -1.0, 1.0, double(NAN)}) {
    EXPECT_THAT(refused([&](auto& o) { o.tolerance = bad; }), HasSubstr("tolerance")) << bad;
  }
}

TEST(ManifoldFault, NamesThePlace) {
  Eigen::Matrix3Xi T(3, 2);
  T << 0, 2, 1, 1, 2, 3;
  EXPECT_EQ(manifold_fault(T, 4), "");
  T.col(1) << 1, 2, 3;
  EXPECT_THAT(manifold_fault(T, 4), HasSubstr("vertices 1 and 2 has two triangles that face"));
  T.col(1) << 2, 3, 4;
  EXPECT_THAT(manifold_fault(T, 5), HasSubstr("vertex 2 is a point where parts"));
  T.col(1) << 3, 4, 5;
  EXPECT_EQ(manifold_fault(T, 6), "");
  Eigen::Matrix3Xi fins(3, 3);
  fins << 0, 1, 0, 1, 0, 1, 2, 3, 4;
  EXPECT_THAT(manifold_fault(fins, 5), HasSubstr("vertices 0 and 1 has more than two triangles"));
}

}  // namespace
}  // namespace deformlab::test
