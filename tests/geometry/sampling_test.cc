#include "geometry/graph/placement/sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <random>

#include "geometry/core/error.h"
#include "geometry/graph/placement/thin_out.h"
#include "tests/support/shapes.h"

namespace deformlab::test {
namespace {

/// Each point's distance to its nearest neighbour.
Eigen::VectorXd nearest_distances(const Eigen::Matrix3Xd& g) {
  Eigen::VectorXd result(g.cols());
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    Eigen::RowVectorXd distance = (g.colwise() - g.col(j)).colwise().norm();
    distance[j] = INFINITY;
    result[j] = distance.minCoeff();
  }
  return result;
}

struct Case {
  const char* name;
  Shape (*shape)();
};

class SampleNodes : public ::testing::TestWithParam<Case> {
 protected:
  const Shape shape_ = GetParam().shape();
};

TEST_P(SampleNodes, GivesExactlyAsManyAsAskedFor) {
  for (const int m : {1, 2, 7, 100, 1000}) {
    const Eigen::Matrix3Xd g = sample_nodes(shape_, m, 1);
    EXPECT_EQ(g.cols(), m);
    EXPECT_TRUE(g.allFinite());
    EXPECT_GT(nearest_distances(g).minCoeff(), 0);  // infinite for one
  }
}

TEST_P(SampleNodes, StaysOnTheShape) {
  const Eigen::Matrix3Xd g = sample_nodes(shape_, 100, 1);
  for (int row = 0; row < 3; ++row) {
    EXPECT_GE(g.row(row).minCoeff(), shape_.V.row(row).minCoeff() - 1e-12);
    EXPECT_LE(g.row(row).maxCoeff(), shape_.V.row(row).maxCoeff() + 1e-12);
  }
}

TEST_P(SampleNodes, SpreadsThemEvenly) {
  // Independent draws come as near as 0.05 of their mean distance; Poisson discs keep apart.
  const Eigen::VectorXd distance = nearest_distances(sample_nodes(shape_, 200, 1));
  EXPECT_GT(distance.minCoeff(), 0.6 * distance.mean());
}

TEST_P(SampleNodes, RepeatsASeedToTheBit) {
  EXPECT_EQ(sample_nodes(shape_, 50, 7), sample_nodes(shape_, 50, 7));
  EXPECT_NE(sample_nodes(shape_, 50, 7), sample_nodes(shape_, 50, 8));
}

TEST_P(SampleNodes, RejectsFewerThanOne) {
  for (const int m : {0, -3}) EXPECT_THROW(sample_nodes(shape_, m, 1), InputError);
}

INSTANTIATE_TEST_SUITE_P(Of, SampleNodes,
                         ::testing::Values(Case{"mesh", [] { return bumpy_plane(40); }},
                                           Case{"point_set", [] { return point_set(5000); }},
                                           Case{"soup", [] { return soup(300); }}),
                         [](const auto& p) { return std::string(p.param.name); });

/// Points of a shape of triangles alone, as the standard library draws them.
Eigen::Matrix3Xd drawn_points(const Shape& shape, int count, std::uint64_t seed) {
  const auto corner = [&](std::size_t t, int c) { return shape.V.col(shape.faces[t][c]); };
  std::vector<double> area;
  for (std::size_t t = 0; t < shape.faces.size(); ++t) {
    const Eigen::Vector3d a = corner(t, 1) - corner(t, 0), b = corner(t, 2) - corner(t, 0);
    area.push_back(a.cross(b).norm() / 2);
  }
  std::mt19937_64 random(seed);
  std::discrete_distribution<std::size_t> triangle(area.begin(), area.end());
  std::uniform_real_distribution<double> uniform;
  Eigen::Matrix3Xd result(3, count);
  for (auto point : result.colwise()) {
    const std::size_t t = triangle(random);
    const double root = std::sqrt(uniform(random)), along = uniform(random);
    point =
        (1 - root) * corner(t, 0) + root * (1 - along) * corner(t, 1) + root * along * corner(t, 2);
  }
  return result;
}

TEST(SampledNodes, AreAmongThePointsThatTheStandardLibraryDraws) {
  for (const int triangles : {1, 2, 3, 300}) {
    Shape shape = point_set(3 * triangles);
    for (int t = 0; t < triangles; ++t) shape.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    if (triangles > 1) shape.V.col(4) = shape.V.col(3);  // one without area
    const Eigen::Matrix3Xd dense = drawn_points(shape, 10000, 5);
    const Eigen::Matrix3Xd nodes = sample_nodes(shape, 100, 5);
    for (const auto g : nodes.colwise()) {
      EXPECT_LT((dense.colwise() - g).colwise().norm().minCoeff(), 1e-15) << triangles;
    }
  }
}

TEST(SampledNodes, PicksAPointSetsOwnPoints) {
  const Shape points = point_set(500);
  const Eigen::Matrix3Xd nodes = sample_nodes(points, 60, 1);
  for (const auto g : nodes.colwise()) {
    EXPECT_EQ((points.V.colwise() - g).colwise().norm().minCoeff(), 0);
  }
}

TEST(SampledNodes, NeedsAsManyDistinctPointsAsNodes) {
  Shape points = point_set(10);
  points.V.rightCols(5) = points.V.leftCols(5).eval();
  EXPECT_EQ(sample_nodes(points, 5, 1).cols(), 5);
  try {
    sample_nodes(points, 6, 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("nodes is 6"),
                                               ::testing::HasSubstr("5 distinct points")));
  }
}

TEST(SampledNodes, TakesTrianglesWithoutAreaForAPointSet) {
  Shape flat = point_set(30);
  flat.V.bottomRows(2).setZero();
  for (int t = 0; t < 10; ++t) flat.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  EXPECT_EQ(sample_nodes(flat, 12, 1).cols(), 12);
}

TEST(SampledNodes, DoesNotDependOnTheUnitOfLength) {
  Shape plane = bumpy_plane(20);
  const Eigen::Matrix3Xd g = sample_nodes(plane, 40, 3);
  plane.V *= 1024;
  EXPECT_EQ(sample_nodes(plane, 40, 3), 1024 * g);
}

// The rule of thin_out by trying all pairs, again and again.
Eigen::Matrix3Xd thinned_by_all_pairs(Eigen::Matrix3Xd g, int m) {
  while (g.cols() > m) {
    Eigen::Index crowded = 0;
    double least = INFINITY;
    for (Eigen::Index a = 0; a < g.cols(); ++a) {
      for (Eigen::Index b = 0; b < a; ++b) {
        const double distance = (g.col(a) - g.col(b)).squaredNorm();
        if (distance < least) least = distance, crowded = a;
      }
    }
    const Eigen::Index after = g.cols() - crowded - 1;
    g.middleCols(crowded, after) = g.rightCols(after).eval();
    g.conservativeResize(3, g.cols() - 1);
  }
  return g;
}

Eigen::Matrix3Xd lattice(int n) {
  Eigen::Matrix3Xd g(3, n * n * n);
  for (int i = 0; i < g.cols(); ++i)
    g.col(i) << 0.1 * (i % n), 0.1 * (i / n % n), 0.1 * (i / n / n);
  return g;
}

TEST(ThinOut, GivesTheSameAsAllPairs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  Eigen::Matrix3Xd anywhere(3, 150);
  for (double& x : anywhere.reshaped()) x = uniform(random);
  Eigen::Matrix3Xd copies(3, 60);
  for (Eigen::Index i = 0; i < copies.cols(); ++i) copies.col(i) = anywhere.col(i % 20);
  for (const Eigen::Matrix3Xd& g : {anywhere, lattice(5), copies}) {
    for (const int m : {1, 2, 19, 59, 1000}) {
      Eigen::Matrix3Xd thinned = g;
      thin_out(thinned, m);
      EXPECT_EQ(thinned, thinned_by_all_pairs(g, m)) << m;
    }
  }
}

TEST(ThinOut, ALatticeTakesLittleTime) {
  Eigen::Matrix3Xd g = lattice(30);
  const auto begin = std::chrono::steady_clock::now();
  thin_out(g, 16000);
  EXPECT_EQ(g.cols(), 16000);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
  Shape points{lattice(30), Eigen::Matrix3Xd(3, 0), {}};
  EXPECT_EQ(sample_nodes(points, 16000, 1).cols(), 16000);
}

}  // namespace
}  // namespace deformlab::test
