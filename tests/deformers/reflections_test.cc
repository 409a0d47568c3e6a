#include "deformers/reflections.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformers/embedded_deformation.h"
#include "geometry/error.h"

namespace deformlab::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A bumpy strip whose right end is turned about its long axis in one shot, the left one held.
Report twist(double degrees, const std::string& reflections) {
  constexpr int nx = 81, ny = 11, held = 6;
  Shape strip;
  strip.V.resize(3, nx * ny);
  Handles handles;
  for (int i = 0; i < nx * ny; ++i) {
    const double x = 4.0 * (i % nx) / (nx - 1), y = 0.5 * (i / nx) / (ny - 1);
    strip.V.col(i) << x, y, 0.02 * std::sin(8 * x) * std::sin(12 * y);
    if (i % nx < held) handles.fixed.push_back(i);
    if (i % nx >= nx - held) handles.moved.push_back(i);
  }
  for (int i = 0; i + nx < nx * ny; ++i) {
    if (i % nx < nx - 1) strip.faces.push_back({i, i + 1, i + nx + 1, i + nx});
  }
  Eigen::Matrix3Xd targets = strip.V(Eigen::all, handles.moved);
  const Eigen::Vector3d centre = targets.rowwise().mean();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitX())
          .toRotationMatrix();
  targets = (R * (targets.colwise() - centre)).colwise() + centre;
  EmbeddedDeformationOptions options;
  options.graph.nodes = 150;
  options.reflections = reflections;
  EmbeddedDeformation deformation(strip, options);
  deformation.compile(handles);
  return deformation.update(targets);
}

class Twists : public ::testing::TestWithParam<double> {};

TEST_P(Twists, AreReportedWhereTheyTurnNodesInsideOut) {
  const Report report = twist(GetParam(), "report");
  EXPECT_GT(report.inside_out, 0);
  EXPECT_LT(report.min_det_R, -0.9);
  EXPECT_THAT(report.notes, Contains(HasSubstr("reflections: repair")));
}

TEST_P(Twists, AreCured) {
  const Report broken = twist(GetParam(), "report"), report = twist(GetParam(), "repair");
  EXPECT_EQ(report.solve.status, Status::kConverged);
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_GT(report.min_det_R, 0.5);
  EXPECT_LT(report.solve.final_cost, broken.solve.final_cost);
  EXPECT_THAT(report.notes, Contains(HasSubstr("turned back")));
}

INSTANTIATE_TEST_SUITE_P(Degrees, Twists, ::testing::Values(150, 170, 180));

TEST(Reflections, AreNoneWhereTheEditIsMild) {
  const Report report = twist(40, "repair"), same = twist(40, "report");
  EXPECT_EQ(report.inside_out, 0);
  EXPECT_EQ(report.solve.final_cost, same.solve.final_cost);
}

TEST(Reflections, OfAnotherNameAreRefused) { EXPECT_THROW(twist(10, "mend"), InputError); }

}  // namespace
}  // namespace deformlab::test
