#include "geometry/plane/locator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/core/error.h"

namespace deformlab::test {
namespace {

// n×n vertices, some of them moved about, over [0, 10]²: two triangles a square, and a square left
// out in the middle.
Triangulation sheet(int n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  Triangulation mesh;
  mesh.V.resize(2, n * n);
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < n * n; ++i) {
    const int x = i % n, y = i / n;
    const bool edge = x == 0 || y == 0 || x == n - 1 || y == n - 1;
    mesh.V.col(i) << x + (edge ? 0 : jitter(random)), y + (edge ? 0 : jitter(random));
    if (x == n - 1 || y == n - 1 || (x == n / 2 && y == n / 2)) continue;
    triangles.emplace_back(i, i + 1, i + n);
    triangles.emplace_back(i + 1, i + 1 + n, i + n);
  }
  mesh.V *= 10.0 / (n - 1);
  mesh.F = Eigen::Map<Eigen::Matrix3Xi>(triangles[0].data(), 3, triangles.size());
  return mesh;
}

Eigen::Vector2d place(const Triangulation& mesh, const Located& located) {
  return mesh.V(Eigen::all, mesh.F.col(located.triangle)) * located.b;
}

// By a dense sample of every triangle's edges and by the signs of its three areas.
double distance_by_hand(const Triangulation& mesh, const Eigen::Vector2d& p) {
  double least = INFINITY;
  for (const auto& t : mesh.F.colwise()) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d a = mesh.V.col(t[k]), u = mesh.V.col(t[(k + 1) % 3]) - a, v = p - a;
      inside = inside && u[0] * v[1] - u[1] * v[0] >= 0;
      for (int s = 0; s <= 200; ++s) least = std::min(least, (v - u * (s / 200.0)).norm());
    }
    if (inside) return 0;
  }
  return least;
}

TEST(Locator, FindsWhatEveryTriangleTriedInTurnGives) {
  const Triangulation mesh = sheet(9);
  const Locator locate(mesh);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-4, 14);
  int outside = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p{uniform(random), uniform(random)};
    const Located found = locate(p);
    EXPECT_NEAR(found.distance, distance_by_hand(mesh, p), 1e-3) << p.transpose();
    EXPECT_NEAR((place(mesh, found) - found.nearest).norm(), 0, 1e-14);
    EXPECT_NEAR((p - found.nearest).norm(), found.distance, 1e-14);
    EXPECT_GE(found.b.minCoeff(), 0);
    EXPECT_NEAR(found.b.sum(), 1, 1e-15);
    outside += found.distance > 0;
  }
  EXPECT_GT(outside, 200);
  EXPECT_LT(outside, 450);
}

TEST(Locator, CountsVerticesAndEdgesAsInsideAndTakesTheFirstTriangle) {
  const Triangulation mesh = sheet(6);
  const Locator locate(mesh);
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d corner = mesh.V.col(mesh.F(k, t));
      const Eigen::Vector2d next = mesh.V.col(mesh.F((k + 1) % 3, t));
      for (const double along : {0.0, 0.3, 0.5}) {
        const Eigen::Vector2d p = (1 - along) * corner + along * next;
        const Located found = locate(p);
        EXPECT_EQ(found.distance, 0);
        EXPECT_EQ(found.nearest, p);
        EXPECT_LE(found.triangle, t);
        EXPECT_NEAR((place(mesh, found) - p).norm(), 0, 1e-14);
      }
    }
  }
}

TEST(Locator, FindsTheRimOfAHole) {
  const Triangulation mesh = sheet(9);  // the square of vertices 40, 41, 49, 50 is left out
  const Eigen::Vector2d center =
      (mesh.V.col(40) + mesh.V.col(41) + mesh.V.col(49) + mesh.V.col(50)) / 4;
  const Located found = Locator(mesh)(center);
  EXPECT_GT(found.distance, 0.2);
  EXPECT_LT(found.distance, 1);
  EXPECT_NEAR(found.b.minCoeff(), 0, 1e-15);  // on an edge
}

TEST(Locator, IsAsExactFarFromTheOrigin) {
  Triangulation mesh = sheet(5);
  mesh.V.colwise() += Eigen::Vector2d(1e6, -3e6);
  const Located found = Locator(mesh)(mesh.V.col(0) + Eigen::Vector2d(0, 1.234567));
  EXPECT_EQ(found.distance, 0);  // on the boundary, but for rounding
  EXPECT_NEAR(found.b.minCoeff(), 0, 1e-9);
}

TEST(Locator, RefusesWhatIsNoPlace) {
  EXPECT_THROW(Locator{Triangulation{}}, InputError);
  const Locator locate(sheet(3));
  EXPECT_THROW(locate({NAN, 0}), InputError);
  EXPECT_THROW(locate({0, INFINITY}), InputError);
}

}  // namespace
}  // namespace deformlab::test
