#include "geometry/plane/overlap/overlap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "tests/support/errors.h"
#include "tests/support/plane.h"

namespace deformlab::test {
namespace {

using ::testing::HasSubstr;
using Pairs = std::map<std::pair<int, int>, double>;

Overlaps overlaps(const Triangulation& rest, const Eigen::Matrix2Xd& V) {
  return OverlapFinder(rest)(V);
}

Pairs pairs(const Overlaps& found) {
  Pairs result;
  for (const auto& [a, b, area] : found.pairs) {
    EXPECT_TRUE(result.emplace(std::minmax(a, b), area).second) << "a pair is listed twice";
  }
  return result;
}

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u[0] * v[1] - u[1] * v[0];
}

/// Area common to two triangles, by clipping one at the edges of the other.
double common_area(Eigen::Matrix<double, 2, 3> a, Eigen::Matrix<double, 2, 3> b) {
  const auto twice = [](const auto& t) { return cross(t.col(1) - t.col(0), t.col(2) - t.col(0)); };
  if (twice(a) == 0 || twice(b) == 0) return 0;
  if (twice(b) < 0) b.col(1).swap(b.col(2));
  std::vector<Eigen::Vector2d> kept{a.col(0), a.col(1), a.col(2)};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d from = b.col(k), along = b.col((k + 1) % 3) - from;
    std::vector<Eigen::Vector2d> next;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Eigen::Vector2d p = kept[i], q = kept[(i + 1) % kept.size()];
      const double at_p = cross(along, p - from), at_q = cross(along, q - from);
      if (at_p >= 0) next.push_back(p);
      if (at_p * at_q < 0) next.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    kept = next;
  }
  double area = 0;
  for (std::size_t i = 2; i < kept.size(); ++i) {
    area += cross(kept[i - 1] - kept[0], kept[i] - kept[0]) / 2;
  }
  return std::abs(area);
}

/// All pairs that overlap by more than rounding, from an area of each with each.
Pairs all_pairs(const Triangulation& mesh) {
  Pairs result;
  for (int a = 0; a < mesh.F.cols(); ++a) {
    for (int b = a + 1; b < mesh.F.cols(); ++b) {
      const double area =
          common_area(mesh.V(Eigen::all, mesh.F.col(a)), mesh.V(Eigen::all, mesh.F.col(b)));
      if (area > 1e-12) result[{a, b}] = area;
    }
  }
  return result;
}

void expect_equal(const Pairs& found, const Pairs& expected) {
  for (const auto& [pair, area] : expected) {
    const auto at = found.find(pair);
    ASSERT_NE(at, found.end()) << pair.first << ", " << pair.second << " of area " << area;
    EXPECT_NEAR(at->second, area, 1e-10);
  }
  for (const auto& [pair, area] : found) {
    EXPECT_TRUE(area < 1e-11 || expected.contains(pair)) << pair.first << ", " << pair.second;
  }
}

/// What lies beyond x = `from`, turned by that much around (from, 0).
Eigen::Matrix2Xd bent_back(const Eigen::Matrix2Xd& V, double from, double angle) {
  Eigen::Matrix2Xd result = V;
  for (auto p : result.colwise()) {
    if (p[0] <= from) continue;
    p = rotation(angle) * (p - Eigen::Vector2d(from, 0)) + Eigen::Vector2d(from, 0);
  }
  return result;
}

/// A strip of unit squares, four high, wound up: it goes around (0, 0) once in `length`.
Eigen::Matrix2Xd wound(const Eigen::Matrix2Xd& V, double length, double rise) {
  Eigen::Matrix2Xd result = V;
  for (auto p : result.colwise()) {
    const double angle = 2 * std::numbers::pi * p[0] / length;
    const double radius = length / (2 * std::numbers::pi) + p[1] + rise * p[0] / length;
    p = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return result;
}

TEST(OverlapFinder, FindsNothingWhereNothingOverlaps) {
  const Triangulation mesh = sheet(9, 7);
  for (const Eigen::Matrix2Xd& V :
       {mesh.V, Eigen::Matrix2Xd(rotation(1) * mesh.V), shaken(mesh.V, 0.2, 1)}) {
    const Overlaps found = overlaps(mesh, V);
    EXPECT_EQ(found.pairs.size(), 0u);
    EXPECT_EQ(found.regions.size(), 0u);
    EXPECT_EQ(found.area, 0);
    EXPECT_EQ(found.turned_over, 0);
    EXPECT_TRUE(found.complete);
  }
  EXPECT_TRUE(overlaps({Eigen::Matrix2Xd(2, 0), Eigen::Matrix3Xi(3, 0)}, Eigen::Matrix2Xd(2, 0))
                  .pairs.empty());
}

/// A U of squares lying on its side: arms 0 ≤ y ≤ 2 and 3 ≤ y ≤ 5, 10 long, joined at the left.
class Arms : public ::testing::Test {
 protected:
  Arms() {
    const Triangulation whole = sheet(11, 6);
    std::vector<int> kept;
    for (int t = 0; t < whole.F.cols(); ++t) {
      const Eigen::Matrix<double, 2, 3> c = whole.V(Eigen::all, whole.F.col(t));
      if (c.row(0).mean() < 2 || c.row(1).mean() < 2 || c.row(1).mean() > 3) kept.push_back(t);
    }
    mesh_ = {whole.V, whole.F(Eigen::all, kept)};
  }

  /// The lower arm's part beyond x = 3 moved by that much.
  Eigen::Matrix2Xd moved(double x, double y) const {
    Eigen::Matrix2Xd V = mesh_.V;
    for (auto p : V.colwise()) {
      if (p[1] > 2.5 && p[0] > 3.5) p += Eigen::Vector2d(x, y);
    }
    return V;
  }

  Triangulation mesh_;
};

TEST_F(Arms, OverlapByARectangle) {
  // Beyond x = 4 the lower arm covers 3 − dy ≤ y, the upper one y ≤ 2.
  const Overlaps found = overlaps(mesh_, moved(0, -1.5));
  ASSERT_EQ(found.regions.size(), 1u);
  // A rectangle 6 × 0.5, and a triangle 1/3 × 0.5 that leads up to it: the edge from (3, 3) to
  // (4, 1.5) is at y = 2 where x = 3 + 2/3.
  EXPECT_NEAR(found.area, 6 * 0.5 + 0.5 * (1.0 / 3) * 0.5, 1e-12);
  EXPECT_NEAR(found.regions[0].area, found.area, 1e-12);
  // The lower arm's rim enters over the upper one's, and leaves at the other end along with it.
  EXPECT_EQ(found.regions[0].crossings, 1);
  EXPECT_FALSE(found.regions[0].twisted);
  EXPECT_EQ(found.turned_over, 0);
  expect_equal(pairs(found), all_pairs({moved(0, -1.5), mesh_.F}));
}

TEST_F(Arms, CrossTwiceWhereOneReachesFarther) {
  const Overlaps found = overlaps(mesh_, moved(-0.25, -1.5));
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_EQ(found.regions[0].crossings, 2);
}

TEST_F(Arms, TouchWithoutOverlap) {
  EXPECT_EQ(overlaps(mesh_, moved(0, -1)).pairs.size(), 0u);    // edge on edge
  EXPECT_EQ(overlaps(mesh_, moved(0.5, -1)).pairs.size(), 0u);  // along each other
  EXPECT_GT(overlaps(mesh_, moved(0, std::nextafter(-1, -2))).pairs.size(), 0u);
  Eigen::Matrix2Xd V = mesh_.V;  // a corner on an edge
  for (auto p : V.colwise()) {
    if (p == Eigen::Vector2d(8, 3)) p = Eigen::Vector2d(7.5, 2);
  }
  EXPECT_EQ(overlaps(mesh_, V).pairs.size(), 0u);
}

TEST_F(Arms, LieOnEachOtherExactly) {
  // By its width: all vertices of one arm on those of the other, so edges on edges everywhere.
  const Overlaps found = overlaps(mesh_, moved(0, -3));
  expect_equal(pairs(found), all_pairs({moved(0, -3), mesh_.F}));
  EXPECT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(std::accumulate(found.regions.begin(), found.regions.end(), 0.0,
                              [](double sum, const auto& r) { return sum + r.area; }),
              found.area, 1e-12);
  EXPECT_GE(found.area, 6 * 2);
}

TEST(OverlapFinder, FindsAStripBentBackOverItself) {
  const Triangulation strip = sheet(41, 5);
  const Eigen::Matrix2Xd V = bent_back(strip.V, 20, 0.8 * std::numbers::pi);
  expect_equal(pairs(overlaps(strip, V)), all_pairs({V, strip.F}));
}

TEST(OverlapFinder, FindsAFoldedStrip) {
  // Mirrored at x = 20: the far half lies on the near one, all of it turned over.
  const Triangulation strip = sheet(41, 5);
  Eigen::Matrix2Xd V = strip.V;
  for (auto p : V.colwise()) p[0] = std::min(p[0], 40 - p[0]);
  const Overlaps found = overlaps(strip, V);
  EXPECT_EQ(found.turned_over, strip.F.cols() / 2);
  EXPECT_NEAR(found.area, 20 * 4, 1e-12);
  EXPECT_EQ(found.regions.size(), 1u);
  expect_equal(pairs(found), all_pairs({V, strip.F}));
}

TEST(OverlapFinder, FindsEachTurnOfASpiral) {
  const Triangulation strip = sheet(121, 5);
  const Eigen::Matrix2Xd V = wound(strip.V, 50.3, 1.5);  // 2.4 turns, each over part of the last
  const Overlaps found = overlaps(strip, V);
  expect_equal(pairs(found), all_pairs({V, strip.F}));
  // Each turn over the next, and by a narrow rim over the one after that.
  ASSERT_EQ(found.regions.size(), 2u);
  EXPECT_FALSE(found.regions[0].twisted || found.regions[1].twisted);
  EXPECT_EQ(overlaps(strip, wound(strip.V, 50.3, 4.5)).pairs.size(), 0u);
}

TEST(OverlapFinder, FindsAHoleThatLiesOverASheet) {
  // A ring far from a plate, joined by a band; then the ring is laid in the middle of the plate.
  Triangulation whole = sheet(31, 11);
  std::vector<int> kept;
  for (int t = 0; t < whole.F.cols(); ++t) {
    const Eigen::Vector2d c = whole.V(Eigen::all, whole.F.col(t)).rowwise().mean();
    const bool plate = c[0]<11, band = c[1]> 4 && c[1]<6, ring = c[0]> 20 && c[0] < 27;
    const bool hole = c[0] > 22 && c[0] < 25 && c[1] > 3 && c[1] < 7;
    if ((plate || (band && c[0] < 27) || (ring && c[1] > 1 && c[1] < 9)) && !hole)
      kept.push_back(t);
  }
  const Triangulation mesh{whole.V, whole.F(Eigen::all, kept)};
  Eigen::Matrix2Xd V = mesh.V;
  for (auto p : V.colwise()) {
    if (p[0] > 15) p = 0.25 * (p - Eigen::Vector2d(23.5, 5)) + Eigen::Vector2d(5.25, 5.125);
  }
  const Overlaps found = overlaps(mesh, V);
  expect_equal(pairs(found), all_pairs({V, mesh.F}));
}

TEST(OverlapFinder, FindsAPlateThatLiesWhollyOverAnother) {
  // Two parts, no rim crosses another.
  Triangulation mesh = sheet(9, 9);
  const Triangulation small = sheet(4, 4);
  const int n = static_cast<int>(mesh.V.cols());
  mesh.V.conservativeResize(2, n + small.V.cols());
  mesh.V.rightCols(small.V.cols()) = small.V.colwise() + Eigen::Vector2d(20, 0);
  mesh.F.conservativeResize(3, mesh.F.cols() + small.F.cols());
  mesh.F.rightCols(small.F.cols()) = small.F.array() + n;
  Eigen::Matrix2Xd V = mesh.V;
  V.rightCols(small.V.cols()) = (rotation(0.5) * small.V).colwise() + Eigen::Vector2d(4.1, 2.2);
  const Overlaps found = overlaps(mesh, V);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(found.area, 9, 1e-12);
  EXPECT_EQ(found.regions[0].crossings, 0);
  expect_equal(pairs(found), all_pairs({V, mesh.F}));
}

TEST(OverlapFinder, MarksABandWhoseSheetsChangePlaces) {
  const auto [rest, V] = twisted_band(80);
  const Overlaps found = overlaps(rest, V);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_TRUE(found.regions[0].twisted);
  expect_equal(pairs(found), all_pairs({V, rest.F}));
}

TEST(OverlapFinder, FindsAllPairsOfAnyDeformation) {
  const Triangulation mesh = triangulate(figure(), {.vertices = 150}, "figure");
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(n);
    Eigen::Matrix2Xd V = mesh.V;  // bent by waves, some of which turn triangles over
    for (int wave = 0; wave < 3; ++wave) {
      const Eigen::Vector2d k = Eigen::Vector2d{normal(random), normal(random)} / 40;
      const Eigen::Vector2d u = 25 * Eigen::Vector2d{normal(random), normal(random)};
      for (Eigen::Index i = 0; i < V.cols(); ++i) V.col(i) += std::sin(k.dot(mesh.V.col(i))) * u;
    }
    const Overlaps found = overlaps(mesh, V);
    ASSERT_TRUE(found.complete);
    expect_equal(pairs(found), all_pairs({V, mesh.F}));
  }
}

TEST(OverlapFinder, FindsAllPairsOfCoordinatesThatCoincide) {
  // Vertices on a coarse grid: corners on edges, edges on edges, triangles without area.
  const Triangulation mesh = sheet(7, 6);
  std::mt19937 random(11);
  for (int n = 0; n < 30; ++n) {
    SCOPED_TRACE(n);
    Eigen::Matrix2Xd V = mesh.V;
    for (auto& entry : V.reshaped()) entry = std::round(entry + int(random() % 3) - 1.0);
    expect_equal(pairs(overlaps(mesh, V)), all_pairs({V, mesh.F}));
  }
}

class Wound : public ::testing::Test {
 protected:
  Triangulation strip_ = sheet(121, 5);
  Eigen::Matrix2Xd V_ = wound(strip_.V, 50.3, 1.5);
};

TEST_F(Wound, IsTheSameOnceMovedOrInAnotherUnit) {
  const Overlaps found = overlaps(strip_, V_);
  const Overlaps scaled = overlaps(strip_, 0x1p-60 * V_);
  const Overlaps turned = overlaps(strip_, (rotation(2) * V_).colwise() + Eigen::Vector2d(9, -7));
  ASSERT_EQ(scaled.pairs.size(), found.pairs.size());
  ASSERT_EQ(turned.pairs.size(), found.pairs.size());
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    EXPECT_EQ(scaled.pairs[i].a, found.pairs[i].a);
    EXPECT_EQ(scaled.pairs[i].area, 0x1p-120 * found.pairs[i].area);
    EXPECT_EQ(turned.pairs[i].a, found.pairs[i].a);
    EXPECT_EQ(turned.pairs[i].b, found.pairs[i].b);
    EXPECT_NEAR(turned.pairs[i].area, found.pairs[i].area, 1e-11);
  }
  EXPECT_EQ(turned.regions.size(), found.regions.size());
}

TEST_F(Wound, IsTheSameWhateverTheOrderOfTriangles) {
  Eigen::VectorXi order = Eigen::VectorXi::LinSpaced(strip_.F.cols(), 0, int(strip_.F.cols()) - 1);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  const Triangulation other{strip_.V, strip_.F(Eigen::all, order)};
  const Overlaps found = overlaps(strip_, V_), shuffled = overlaps(other, V_);
  Pairs renamed;
  for (const auto& [pair, area] : pairs(shuffled)) {
    renamed[std::minmax(order[pair.first], order[pair.second])] = area;
  }
  expect_equal(renamed, pairs(found));
  ASSERT_EQ(shuffled.regions.size(), found.regions.size());
  EXPECT_EQ(shuffled.regions[0].crossings, found.regions[0].crossings);
}

TEST_F(Wound, GivesTheSameBytesTwice) {
  const Overlaps one = overlaps(strip_, V_), other = overlaps(strip_, V_);
  ASSERT_EQ(one.pairs.size(), other.pairs.size());
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].a, other.pairs[i].a);
    EXPECT_EQ(one.pairs[i].b, other.pairs[i].b);
    EXPECT_EQ(one.pairs[i].area, other.pairs[i].area);
  }
  EXPECT_EQ(one.area, other.area);
}

TEST(OverlapFinder, GivesUpOnTangles) {
  // All vertices at random: each triangle lies over a good share of all others.
  const Triangulation mesh = sheet(60, 60);
  Eigen::Matrix2Xd V = shaken(mesh.V, 1e3, 2);
  Overlaps found = overlaps(mesh, V);
  EXPECT_FALSE(found.complete);
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_TRUE(found.regions.empty());
  EXPECT_EQ(found.area, 0);
  EXPECT_GT(found.turned_over, 0);
  V.setZero();  // all in one place: nothing has an area
  found = overlaps(mesh, V);
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.pairs.empty());
}

TEST(OverlapFinder, TakesMeshesThatAreNoManifold) {
  // Three triangles at one edge, and one listed twice: they lie on each other.
  Triangulation mesh{polygon({{0, 0}, {2, 0}, {1, 1}, {1, 2}, {1, -1}}), Eigen::Matrix3Xi(3, 4)};
  mesh.F << 0, 0, 1, 0,  //
      1, 1, 0, 1,        //
      2, 3, 4, 2;
  const Overlaps found = overlaps(mesh, mesh.V);
  expect_equal(pairs(found), all_pairs(mesh));
  EXPECT_EQ(found.pairs.size(), 3u);
}

TEST(OverlapFinder, RefusesWhatDoesNotFit) {
  const Triangulation mesh = sheet(3, 3);
  const auto refused = [&](Triangulation rest, const Eigen::Matrix2Xd& V) -> std::string {
    return test::error_of([&] { overlaps(rest, V); });
  };
  EXPECT_EQ(refused(mesh, Eigen::Matrix2Xd::Zero(2, 8)),
            "there are 8 deformed vertices; at rest there are 9");
  Eigen::Matrix2Xd V = mesh.V;
  V(1, 4) = NAN;
  EXPECT_THAT(refused(mesh, V), HasSubstr("deformed vertex 4 is at (1, nan)"));
  V(1, 4) = INFINITY;
  EXPECT_THAT(refused(mesh, V), HasSubstr("deformed vertex 4 is at (1, inf)"));
  V(1, 4) = -1e101;
  EXPECT_THAT(refused(mesh, V), HasSubstr("mend the handles, or scale"));
  Triangulation broken = mesh;
  broken.F(2, 0) = 9;
  EXPECT_THAT(refused(broken, mesh.V), HasSubstr("its vertices are 0 to 8"));
  broken.F(2, 0) = -1;
  EXPECT_THAT(refused(broken, mesh.V), HasSubstr("names a vertex that the mesh does not have"));
}

}  // namespace
}  // namespace deformlab::test
