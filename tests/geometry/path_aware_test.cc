#include "geometry/transfer/path_aware.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/shape/weld.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

double distance_to(const NearestSources& nearest, int vertex, int source) {
  for (int a = 0; a < nearest.found[vertex]; ++a) {
    if (nearest.sources(a, vertex) == source) return nearest.distances(a, vertex);
  }
  return -1;
}

// A plane of n×n vertices over the unit square, rolled up to a tube that does not quite close: the
// left and the right edge come near each other.
Shape rolled_plane(int n) {
  Shape shape = bumpy_plane(n, 1, 0);
  for (auto p : shape.V.colwise()) {
    const double angle = 1.9 * std::numbers::pi * p[0];
    p = Eigen::Vector3d(std::cos(angle), std::sin(angle), 6 * p[1]);
  }
  return shape;
}

TEST(Weld, NamesTheFirstVertexAtAPosition) {
  Eigen::Matrix3Xd V(3, 5);
  V << 0, 1, -0.0, 1, 1,  //
      0, 2, 0, 2, 2,      //
      0, 3, 0, 3, 4;
  EXPECT_EQ(weld(V), (std::vector<int>{0, 1, 0, 1, 4}));
}

TEST(PathAware, IsStraightOnAFlatSurface) {
  const Shape plane = bumpy_plane(21, 1, 0);
  const std::vector<int> sources = {0, 20, 220, 420, 440};
  const NearestSources nearest = nearest_path_aware(WeldedSurface(plane), sources, 5);
  for (int i = 0; i < plane.V.cols(); ++i) {
    for (int s = 0; s < 5; ++s) {
      EXPECT_NEAR(distance_to(nearest, i, s), (plane.V.col(i) - plane.V.col(sources[s])).norm(),
                  1e-12);
    }
  }
}

// So many that there are paths between some vertices only, of which each part needs one.
TEST(PathAware, EachOfManyPartsHasPaths) {
  constexpr int kParts = 3000;
  Shape shape;
  shape.V.resize(3, 3 * kParts);
  std::vector<int> sources;
  for (int p = 0; p < kParts; ++p) {
    const double x = p * 7919 % kParts;
    shape.V.middleCols<3>(3 * p) << x, x + 0.1, x, 0, 0, 0.1, 0, 0, 0;
    shape.faces.push_back({3 * p, 3 * p + 1, 3 * p + 2});
    if (p % 10 == 0) sources.push_back(3 * p);  // which are stops anyway
  }
  const NearestSources nearest = nearest_path_aware(WeldedSurface(shape), sources, 4);
  for (int i = 0; i < shape.V.cols(); ++i) {
    ASSERT_EQ(nearest.found[i], 4) << i;
    EXPECT_NEAR(nearest.distances(0, i),
                (shape.V.col(i) - shape.V.col(sources[nearest.sources(0, i)])).norm(), 0.2);
  }
}

TEST(PathAware, GoesAlongTheSurfaceWhereThatIsALongWayRound) {
  for (const int n : {21, 121}) {  // with paths between all vertices, and between some of them
    const Shape shape = rolled_plane(n);
    const int left = n / 2 * n, right = left + n - 1;
    const NearestSources nearest =
        nearest_path_aware(WeldedSurface(shape), std::vector<int>{left, right}, 2);
    const double path = 1.9 * std::numbers::pi;
    EXPECT_NEAR(distance_to(nearest, right, 0) / (0.8 * path), 1, 0.05);
    EXPECT_EQ(distance_to(nearest, right, 1), 0);
  }
}

TEST(PathAware, AShapeThatIsCutIntoChartsIsOneSurface) {
  Shape whole = rolled_plane(21);
  const Eigen::Matrix3Xi T = triangles(whole);
  whole.faces.clear();
  for (const auto t : T.colwise()) whole.faces.push_back({t[0], t[1], t[2]});
  Shape charts{Eigen::Matrix3Xd(3, 3 * whole.faces.size()), {}, {}};
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    for (int c = 0; c < 3; ++c) {
      charts.V.col(static_cast<Eigen::Index>(3 * f) + c) = whole.V.col(whole.faces[f][c]);
    }
    const int first = static_cast<int>(3 * f);
    charts.faces.push_back({first, first + 1, first + 2});
  }
  const NearestSources one = nearest_path_aware(WeldedSurface(whole), std::vector<int>{0, 440}, 2);
  std::vector<int> sources;
  for (const int v : {0, 440}) {
    Eigen::Index at = 0;
    (charts.V.colwise() - whole.V.col(v)).colwise().norm().minCoeff(&at);
    sources.push_back(static_cast<int>(at));
  }
  const NearestSources other = nearest_path_aware(WeldedSurface(charts), sources, 2);
  for (std::size_t f = 0; f < whole.faces.size(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int i = whole.faces[f][c];
      EXPECT_NEAR(distance_to(other, static_cast<int>(3 * f) + c, 0), distance_to(one, i, 0), 1e-9);
    }
  }
}

TEST(PathAware, APartThatNothingJoinsFollowsWhatIsNearInSpace) {
  const Shape button = bumpy_plane(3, 0.1, 0);
  const Shape shape = side_by_side(bumpy_plane(11, 1, 0), button, {0.45, 0.45, 0.01});
  const std::vector<int> sources = {60, 0, 10, 121};  // the last is on the button
  const NearestSources nearest = nearest_path_aware(WeldedSurface(shape), sources, 4);
  for (int i = 121; i < shape.V.cols(); ++i) {
    ASSERT_EQ(nearest.found[i], 4);
    for (int s = 0; s < 4; ++s) {
      EXPECT_NEAR(distance_to(nearest, i, s), (shape.V.col(i) - shape.V.col(sources[s])).norm(),
                  1e-12);
    }
  }
}

}  // namespace
}  // namespace deformlab::test
