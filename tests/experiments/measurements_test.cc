#include "experiments/measure/measurements.h"

#include <gtest/gtest.h>

#include "tests/support/program.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

// A flat sheet over the unit square whose right half is stretched along x, to twice its width.
struct Stretched {
  Shape rest = bumpy_plane(21, 1, 0), now = rest;
  std::vector<int> left, right;

  Stretched() {
    for (int i = 0; i < rest.V.cols(); ++i) {
      const double x = rest.V(0, i);
      if (x > 0.5) now.V(0, i) = 0.5 + 2 * (x - 0.5);
      if (x < 0.501) left.push_back(i);
      if (x > 0.499) right.push_back(i);
    }
  }
};

TEST(RegionDistortion, IsOfThePartAlone) {
  const Stretched s;
  const Metrics left = region_distortion(s.rest, s.now, s.left);
  const Metrics right = region_distortion(s.rest, s.now, s.right);
  EXPECT_NEAR(left.at("region.stretch_max"), 0, 1e-9);
  EXPECT_NEAR(left.at("region.edge_error_mean"), 0, 1e-9);
  EXPECT_NEAR(right.at("region.stretch_mean"), 1, 1e-9);
  EXPECT_GT(right.at("region.edge_error_mean"), 0.3);
}

TEST(RegionDistortion, OfAllVerticesIsThatOfTheShape) {
  const Stretched s;
  std::vector<int> all;
  for (int i = 0; i < s.rest.V.cols(); ++i) all.push_back(i);
  const Metrics region = region_distortion(s.rest, s.now, all);
  for (const auto& [name, value] : distortion(s.rest, s.now)) {
    EXPECT_EQ(region.at("region." + name), value) << name;
  }
}

TEST(RegionDistortion, OfVerticesWithoutATriangleIsNothing) {
  const Stretched s;
  EXPECT_TRUE(region_distortion(s.rest, s.now, {0, 5}).empty());
  EXPECT_TRUE(region_distortion(s.rest, s.now, {}).empty());
}

class MeasureRegion : public Program {
 protected:
  MeasureRegion() {
    put("c.yaml",
        "title: t\nshape: {columns: 12, rows: 12}\ngraph: {nodes: 12}\n"
        "edit:\n"
        "  - {select: {box: {min: [-1, -1, -1], max: [0.1, 2, 1]}}, fix: true}\n"
        "  - {select: {nearest: [1, 0.5, 0]}, by: [0.2, 0, 0.3]}\n"
        "picture: {width: 40, height: 30}\n");
  }
};

TEST_F(MeasureRegion, IsWhatClaimsMaySpeakOf) {
  const Ending ending = expect_success(
      {"run", "c.yaml", "measure.region={box: {min: [-1, -1, -1], max: [0.1, 2, 1]}}",
       "claims=[{name: it, measure: region.edge_error_mean, at_most: 1e-9}]"});
  EXPECT_THAT(ending.out, ::testing::HasSubstr("claim it: measured"));
}

TEST_F(MeasureRegion, RefusesWhatSelectsNothing) {
  const std::pair<std::string, Words> bad[] = {
      {"measure.region=3", {"measure.region", "map"}},
      {"measure.region={vertices: [144]}", {"measure.region", "144"}},
      {"measure.region={sphere: {center: [9, 9, 9], radius: 1}}", {"measure.region", "no vert"}},
      {"measure.region={bax: 3}", {"'bax'", "'box'"}}};
  for (const auto& [change, words] : bad) {
    SCOPED_TRACE(change);
    expect_refused({"run", "c.yaml", change}, words);
  }
}

}  // namespace
}  // namespace deformlab::test
