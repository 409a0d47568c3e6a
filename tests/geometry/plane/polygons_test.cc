#include "geometry/plane/polygons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "geometry/plane/boundary_sampling.h"
#include "tests/support/plane.h"

namespace deformlab::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Pair = std::pair<PolygonEdge, PolygonEdge>;

std::set<Pair> meetings(const Polygons& polygons) {
  std::set<Pair> found;
  for_edges_that_meet(polygons, [&](const PolygonEdge& e, const PolygonEdge& f) {
    EXPECT_LT(e, f);
    EXPECT_TRUE(found.emplace(e, f).second) << "told twice";
  });
  return found;
}

Pair edges(int p, int e, int q, int f) { return {{p, e}, {q, f}}; }

TEST(EdgesThatMeet, FollowEachOtherInPeace) {
  EXPECT_THAT(meetings({}), IsEmpty());
  EXPECT_THAT(meetings({box(0, 0, 2, 2), box(3, 0, 5, 2), box(0.5, 0.5, 1, 1)}), IsEmpty());
  EXPECT_THAT(meetings({polygon({{0, 0}, {1, 0}, {2, 0}, {2, 2}})}), IsEmpty());
}

TEST(EdgesThatMeet, CrossTouchAndRunBack) {
  EXPECT_THAT(meetings({polygon({{0, 0}, {4, 4}, {4, 0}, {0, 4}})}),
              ElementsAre(edges(0, 0, 0, 2)));
  // One polygon's corner on the other's edge: both edges at it meet that edge.
  EXPECT_THAT(meetings({box(0, 0, 2, 2), polygon({{2, 1}, {3, 0}, {3, 2}})}),
              ElementsAre(edges(0, 1, 1, 0), edges(0, 1, 1, 2)));
  // Along each other.
  EXPECT_THAT(meetings({box(0, 0, 2, 2), box(2, 0.5, 3, 1)}),
              ::testing::Contains(edges(0, 1, 1, 3)));
  // An edge that runs back along the one before it, also across the first corner.
  EXPECT_THAT(meetings({polygon({{0, 0}, {9, 0}, {5, 0}, {5, 5}})}),
              ::testing::Contains(edges(0, 0, 0, 1)));
  EXPECT_THAT(meetings({polygon({{9, 0}, {5, 0}, {5, 5}, {0, 0}})}),
              ::testing::Contains(edges(0, 0, 0, 3)));
  // Two corners: there and back.
  EXPECT_THAT(meetings({polygon({{0, 0}, {1, 1}})}), ElementsAre(edges(0, 0, 0, 1)));
}

TEST(EdgesThatMeet, AreToldApartToTheLastDigit) {
  const double above = std::nextafter(1.0, 2.0);
  const Eigen::Matrix2Xd roof = polygon({{0, above}, {3, above}, {1, 4}});
  EXPECT_THAT(meetings({polygon({{0, 0}, {2, 0}, {1, 1}}), roof}), IsEmpty());
  EXPECT_EQ(meetings({polygon({{0, 0}, {2, 0}, {1, above}}), roof}).size(), 2u);
}

TEST(EdgesThatMeet, AreThoseThatAllPairsGive) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 10);
  const auto cross = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
    return u[0] * v[1] - u[1] * v[0];
  };
  for (int n = 0; n < 20; ++n) {
    Polygons polygons{Eigen::Matrix2Xd(2, 40), Eigen::Matrix2Xd(2, 3)};
    for (auto& polygon : polygons) {
      for (auto& entry : polygon.reshaped()) entry = uniform(random);
    }
    std::vector<std::array<Eigen::Vector2d, 2>> segments;
    std::vector<PolygonEdge> names;
    for (int p = 0; p < 2; ++p) {
      for (Eigen::Index i = 0; i < polygons[p].cols(); ++i) {
        segments.push_back({polygons[p].col(i), polygons[p].col((i + 1) % polygons[p].cols())});
        names.push_back({p, i});
      }
    }
    std::set<Pair> expected;  // at random there are proper crossings only
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (std::size_t j = i + 1; j < segments.size(); ++j) {
        const auto& [a, b] = segments[i];
        const auto& [c, d] = segments[j];
        if (a == d || b == c) continue;
        if (cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
            cross(d - c, a - c) * cross(d - c, b - c) < 0)
          expected.insert({names[i], names[j]});
      }
    }
    EXPECT_EQ(meetings(polygons), expected);
  }
}

TEST(Nesting, NamesAllPolygonsAround) {
  const Polygons polygons{box(0, 0, 9, 9), box(1, 1, 5, 5), box(2, 2, 3, 3), box(6, 6, 8, 8),
                          box(20, 0, 21, 1)};
  EXPECT_THAT(nesting(polygons),
              ElementsAre(IsEmpty(), ElementsAre(0), ElementsAre(0, 1), ElementsAre(0), IsEmpty()));
  // In the notch of one, so inside its box but not inside it.
  EXPECT_THAT(nesting({polygon({{0, 0}, {9, 0}, {9, 9}, {8, 1}}), box(2, 3, 4, 5)}),
              ElementsAre(IsEmpty(), IsEmpty()));
  EXPECT_THAT(nesting({}), IsEmpty());
}

TEST(CornerNearEdge, IsTheFirstOfThem) {
  const Polygons polygons{box(0, 0, 9, 9), box(0.5, 3, 5, 8.75)};
  EXPECT_EQ(corner_near_edge(polygons, 0.25), std::nullopt);
  EXPECT_EQ(corner_near_edge(polygons, 0.3), (PolygonEdge{1, 2}));
  EXPECT_EQ(corner_near_edge(polygons, 0.52), (PolygonEdge{1, 0}));
  EXPECT_EQ(corner_near_edge({}, 1), std::nullopt);
  // The tip of a needle is near the edge across, its ends are not near the edges that they end.
  EXPECT_EQ(corner_near_edge({polygon({{0, 0}, {9, 0}, {9, 0.1}})}, 0.2), (PolygonEdge{0, 1}));
}

/// How far corners of one polygon are from the other, at most.
double farthest(const Eigen::Matrix2Xd& corners, const Eigen::Matrix2Xd& polygon) {
  double most = 0;
  for (const auto& p : corners.colwise()) {
    double least = std::numeric_limits<double>::max();
    for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
      const Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - a - t * (b - a)).norm());
    }
    most = std::max(most, least);
  }
  return most;
}

TEST(Resampled, PutsCornersEvenlyAndKeepsSharpOnes) {
  const Region region = checked({box(0, 0, 100, 40), {circle({50, 20}, 10, 100)}}, "it");
  const Region coarse = resampled(region, [](const Eigen::Vector2d&) { return 7.0; });
  for (const auto& corner : region.outline.colwise()) {
    EXPECT_EQ((coarse.outline.colwise() - corner).colwise().norm().minCoeff(), 0);
  }
  const Eigen::Index n = coarse.outline.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double length = (coarse.outline.col((i + 1) % n) - coarse.outline.col(i)).norm();
    EXPECT_GT(length, 6);
    EXPECT_LT(length, 8);
  }
  EXPECT_LT(farthest(region.holes[0], coarse.holes[0]), 0.1 * 7);
  EXPECT_LE(coarse.holes[0].cols(), 14);
  EXPECT_NO_THROW(checked(coarse, "it"));
}

TEST(Resampled, KeepsPolygonsApartWhereverTheyAreNearerThanTheSpacing) {
  Region region = checked({circle({0, 0}, 50, 500), {circle({0, 0}, 49.5, 500)}}, "it");
  region = resampled(region, [](const Eigen::Vector2d&) { return 20.0; });
  EXPECT_NO_THROW(checked(region, "it"));
  EXPECT_GT(area(region), 0.5 * std::numbers::pi * (50 * 50 - 49.5 * 49.5));
}

TEST(Resampled, FollowsTheSpacing) {
  const Region region = checked({box(0, 0, 100, 10), {}}, "it");
  const Region uneven =
      resampled(region, [](const Eigen::Vector2d& p) { return p[0] < 50 ? 1.0 : 5.0; });
  const auto x = uneven.outline.row(0).array();
  EXPECT_NEAR(double((x < 49).count()), 50 * 2 + 9, 5);
  EXPECT_NEAR(double((x > 51).count()), 10 * 2 + 1, 4);
}

}  // namespace
}  // namespace deformlab::test
