#include "geometry/transfer/geodesic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "geometry/core/error.h"
#include "tests/support/errors.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The unit sphere: an octahedron whose triangles are cut into four so many times.
Shape sphere(int times) {
  Shape shape;
  shape.V.resize(3, 6);
  shape.V << 1, -1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -1;
  shape.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (; times > 0; --times) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), shape.V.cols());
      if (is_new) {
        shape.V.conservativeResize(3, shape.V.cols() + 1);
        shape.V.rightCols<1>() = (shape.V.col(a) + shape.V.col(b)).normalized();
      }
      return at->second;
    };
    std::vector<std::vector<int>> faces;
    for (const auto& f : shape.faces) {
      const int a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      faces.insert(faces.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
    }
    shape.faces = std::move(faces);
  }
  return shape;
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return 2 * std::asin((a - b).norm() / 2);
}

// Mean and largest of |d / exact − 1| over the nearest sources of every vertex but a source itself.
struct Errors {
  double mean = 0, max = 0;
};

template <class Exact>
Errors errors(const NearestSources& nearest, Exact&& exact) {
  Errors result;
  int count = 0;
  for (int i = 0; i < nearest.found.size(); ++i) {
    for (int a = 0; a < nearest.found[i]; ++a) {
      const double d = exact(nearest.sources(a, i), i);
      if (d == 0) continue;
      const double error = std::abs(nearest.distances(a, i) / d - 1);
      result.max = std::max(result.max, error);
      result.mean += error;
      ++count;
    }
  }
  result.mean /= count;
  return result;
}

class Nearest : public ::testing::TestWithParam<std::string> {
 protected:
  static bool is_edges() { return GetParam() == "edges"; }
  static NearestSources nearest_of(const Shape& shape, const std::vector<int>& sources, int count) {
    return (is_edges() ? nearest_along_edges : nearest_along_surface)(shape, sources, count);
  }
};
INSTANTIATE_TEST_SUITE_P(Along, Nearest, ::testing::Values("surface", "edges"),
                         [](const auto& test) { return test.param; });

TEST_P(Nearest, OnAPlaneIsTheStraightDistance) {
  const Shape plane = bumpy_plane(31, 1, 0);
  const std::vector<int> sources{32, 480, 700, 955, 28};
  const Errors e = errors(nearest_of(plane, sources, 3), [&](int s, int i) {
    return (plane.V.col(sources[s]) - plane.V.col(i)).norm();
  });
  // Paths go along eight directions: at 22.5 degrees to one they are 8.2 % too long.
  const double worst_path = 1 / std::cos(std::numbers::pi / 8) - 1;
  EXPECT_LT(e.mean, is_edges() ? 0.031 : 0.004);
  EXPECT_LT(e.max, is_edges() ? worst_path + 1e-12 : 0.042);
}

TEST_P(Nearest, OnASphereIsTheArc) {
  const Shape ball = sphere(4);  // 1,026 vertices
  const std::vector<int> sources{0, 5, 100, 400, 900};
  const Errors e = errors(nearest_of(ball, sources, 3), [&](int s, int i) {
    return angle(ball.V.col(sources[s]), ball.V.col(i));
  });
  EXPECT_LT(e.mean, is_edges() ? 0.022 : 0.016);
  EXPECT_LT(e.max, is_edges() ? 0.077 : 0.031);
}

TEST_P(Nearest, GoesAroundAndNotAcross) {
  // Two planes, one above the other and joined along an edge only: a folded sheet.
  constexpr int n = 21;
  Shape sheet = bumpy_plane(n, 1, 0);
  for (auto v : sheet.V.colwise()) {
    if (v.x() > 0.5) v = Eigen::Vector3d(1 - v.x(), v.y(), 0.01);
  }
  const int source = 10 * n, opposite = 10 * n + 20;
  const NearestSources nearest = nearest_of(sheet, {source}, 1);
  EXPECT_LT((sheet.V.col(source) - sheet.V.col(opposite)).norm(), 0.02);
  EXPECT_NEAR(nearest.distances(0, opposite), 1, 0.05);
}

TEST_P(Nearest, ComesNearestFirstAndOnlyWhereTheSurfaceLeads) {
  Shape two = side_by_side(bumpy_plane(9), bumpy_plane(9), {0.1, 0, 0.01});
  two.V.conservativeResize(3, 163);
  two.V.rightCols<1>().setZero();  // a vertex without a face
  const std::vector<int> sources{0, 40, 100, 162};
  const NearestSources nearest = nearest_of(two, sources, 3);
  for (int i = 0; i < 163; ++i) {
    ASSERT_EQ(nearest.found[i], i < 81 ? 2 : 1) << i;
    const bool first = i < 81;
    for (int a = 0; a < nearest.found[i]; ++a) {
      const int s = nearest.sources(a, i);
      EXPECT_EQ(first, s < 2) << i;
      EXPECT_EQ(i == 162, s == 3) << i;
      EXPECT_LE(nearest.distances(std::max(a - 1, 0), i), nearest.distances(a, i)) << i;
    }
  }
  EXPECT_EQ(nearest.distances(0, 40), 0);
  EXPECT_EQ(nearest.distances(0, 162), 0);
}

TEST_P(Nearest, TwoSourcesOnOneVertexBothCount) {
  const NearestSources nearest = nearest_of(bumpy_plane(9), std::vector<int>{7, 40, 40}, 3);
  EXPECT_EQ(nearest.found.minCoeff(), 3);
  EXPECT_EQ(nearest.distances(0, 40), 0);
  EXPECT_EQ(nearest.distances(1, 40), 0);
  EXPECT_EQ(nearest.sources(0, 40), 1);
  EXPECT_EQ(nearest.sources(1, 40), 2);
}

TEST_P(Nearest, IsTheSameTwiceAndInAnyUnit) {
  const Shape plane = bumpy_plane(15);
  Shape in_km = plane;
  in_km.V /= 1024;
  const std::vector<int> sources{3, 77, 150, 200};
  const NearestSources one = nearest_of(plane, sources, 2), two = nearest_of(plane, sources, 2),
                       small = nearest_of(in_km, sources, 2);
  EXPECT_EQ(one.sources, two.sources);
  EXPECT_EQ(one.distances, two.distances);
  EXPECT_LT((1024 * small.distances - one.distances).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Surface, LiesBetweenTheStraightLineAndThePath) {
  const Shape plane = bumpy_plane(21, 1, 0.1);
  const std::vector<int> sources{0, 200, 333};
  const NearestSources d = nearest_along_surface(plane, sources, 3),
                       paths = nearest_along_edges(plane, sources, 3);
  for (int i = 0; i < plane.V.cols(); ++i) {
    for (int a = 0; a < 3; ++a) {
      const int s = d.sources(a, i);
      const Eigen::Index b =
          std::find(paths.sources.col(i).begin(), paths.sources.col(i).end(), s) -
          paths.sources.col(i).begin();
      EXPECT_GE(d.distances(a, i), (plane.V.col(i) - plane.V.col(sources[s])).norm() * (1 - 1e-12));
      EXPECT_LE(d.distances(a, i), paths.distances(b, i) * (1 + 1e-12));
    }
  }
}

TEST(Surface, NeedsAManifoldMesh) {
  const auto refused = [](const Shape& shape) -> std::string {
    return test::error_of([&] { nearest_along_surface(shape, std::vector<int>{0}, 1); });
  };
  EXPECT_THAT(refused(point_set(10)), HasSubstr("no faces"));
  Shape fins = bumpy_plane(10);
  fins.faces.push_back({0, 1, 55});
  EXPECT_THAT(refused(fins), HasSubstr("manifold"));
}

TEST(Surface, TrianglesOfNoAreaAreRefused) {
  Shape plane = bumpy_plane(15, 1, 0);
  plane.V.col(100) = plane.V.col(101);
  const std::vector<int> sources{0, 49, 100};
  EXPECT_THROW(nearest_along_surface(plane, sources, 3), InputError);
}

TEST(Edges, TakeAnySurface) {
  Shape fins = bumpy_plane(10);
  fins.faces.push_back({0, 1, 55});
  fins.faces.push_back({0, 1, 77});
  fins.faces.push_back({5, 5, 6});
  fins.V.col(44) = fins.V.col(45);
  const NearestSources nearest = nearest_along_edges(fins, std::vector<int>{0}, 1);
  EXPECT_EQ(nearest.found.minCoeff(), 1);
  EXPECT_TRUE(nearest.distances.allFinite());
  EXPECT_NEAR(nearest.distances(0, 77), (fins.V.col(0) - fins.V.col(77)).norm(), 1e-15);
  const NearestSources alone = nearest_along_edges(point_set(10), std::vector<int>{3}, 2);
  EXPECT_EQ(alone.found.sum(), 1);
  EXPECT_EQ(alone.distances(0, 3), 0);
  EXPECT_EQ(alone.distances(1, 3), kInfinity);
}

TEST(Edges, FindWhatASearchFromEachSourceFinds) {
  const Shape plane = bumpy_plane(15);
  std::vector<int> sources;
  for (int s = 0; s < 20; ++s) sources.push_back(11 * s);
  const NearestSources together = nearest_along_edges(plane, sources, 4);
  std::vector<NearestSources> each;
  for (const int s : sources) each.push_back(nearest_along_edges(plane, std::vector<int>{s}, 1));
  for (int i = 0; i < plane.V.cols(); ++i) {
    std::vector<double> all;
    for (const NearestSources& one : each) all.push_back(one.distances(0, i));
    std::sort(all.begin(), all.end());
    for (int a = 0; a < 4; ++a) EXPECT_NEAR(together.distances(a, i), all[a], 1e-12);
  }
}

TEST(ConnectedParts, AreNumberedByTheirFirstVertices) {
  Shape two = side_by_side(bumpy_plane(3), bumpy_plane(3), {0, 0, 1});
  two.V.conservativeResize(3, 19);
  two.V.rightCols<1>().setZero();
  const std::vector<int> part = connected_parts(two);
  for (int i = 0; i < 19; ++i) EXPECT_EQ(part[i], i / 9) << i;
}

}  // namespace
}  // namespace deformlab::test
