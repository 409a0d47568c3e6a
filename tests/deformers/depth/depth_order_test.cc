#include "deformers/depth/depth_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <random>

#include "geometry/plane/overlap/overlap_measure.h"
#include "tests/support/errors.h"
#include "tests/support/plane.h"

namespace deformlab::test {
namespace {

using Eigen::Index;
using ::testing::HasSubstr;

/// A U that lies on its side: the squares of a sheet of 11 × 6 vertices, 1 apart, without those
/// between two arms. Arm `a` is at y ≤ 2, arm `b` at y ≥ 3, and they are joined at x < 2.
Triangulation arms() {
  const Triangulation whole = sheet(11, 6);
  std::vector<int> kept;
  for (int t = 0; t < whole.F.cols(); ++t) {
    const Eigen::Vector2d c = whole.V(Eigen::all, whole.F.col(t)).rowwise().mean();
    if (c[0] < 2 || c[1] < 2 || c[1] > 3) kept.push_back(t);
  }
  return {whole.V, whole.F(Eigen::all, kept)};
}

Eigen::Matrix2Xd changed(const Triangulation& mesh,
                         const std::function<void(Eigen::Vector2d&)>& change) {
  Eigen::Matrix2Xd V = mesh.V;
  for (auto column : V.colwise()) {
    Eigen::Vector2d p = column;
    change(p);
    column = p;
  }
  return V;
}

/// Moves the part of arm b at x > 3.5 by y: −1.5 lays its edge over arm a, −6 takes it beyond arm
/// a.
Eigen::Matrix2Xd dragged(const Triangulation& mesh, double y) {
  return changed(mesh, [&](Eigen::Vector2d& p) {
    if (p[0] > 3.5 && p[1] > 2.5) p[1] += y;
  });
}

Eigen::VectorXd order_of(const Triangulation& mesh,
                         const std::function<double(const Eigen::Vector2d&)>& order) {
  Eigen::VectorXd result(mesh.V.cols());
  for (Index v = 0; v < result.size(); ++v) result[v] = order(mesh.V.col(v));
  return result;
}

double interpenetration_of(const DepthOrder& order, const Triangulation& rest,
                           const Eigen::Matrix2Xd& V) {
  return interpenetration({V, rest.F}, order.overlaps(), triangle_depths(order.depth())).area;
}

/// Expects that no two triangles that overlap have the same depth, and that in each region one
/// sheet is wholly in front unless the update reported otherwise.
void expect_stacked(const DepthOrder& order, const Triangulation& rest, const Eigen::Matrix2Xd& V) {
  for (const TrianglePair& pair : order.overlaps().pairs) {
    ASSERT_NE(order.depth()[pair.a], order.depth()[pair.b]);
  }
  EXPECT_TRUE(order.report().cyclic > 0 || interpenetration_of(order, rest, V) == 0);
  EXPECT_GE(order.depth().minCoeff(), 0);
  EXPECT_EQ(order.depth(), order.depth().array().round().matrix());
}

/// Whether arm b is in front wherever the arms overlap.
bool b_in_front(const DepthOrder& order, const Triangulation& rest) {
  const auto in_b = [&](int t) { return rest.V(Eigen::all, rest.F.col(t)).row(1).mean() > 2.5; };
  double b = 0, all = 0;
  for (const TrianglePair& pair : order.overlaps().pairs) {
    if (in_b(pair.a) == in_b(pair.b)) continue;
    const int upper = order.depth()[pair.a] > order.depth()[pair.b] ? pair.a : pair.b;
    b += in_b(upper) ? pair.area : 0;
    all += pair.area;
  }
  EXPECT_GT(all, 0);
  EXPECT_TRUE(b == 0 || b == all);
  return b > 0;
}

TEST(DepthOrder, IsFlatWhereNothingOverlaps) {
  const Triangulation mesh = arms();
  DepthOrder order(mesh, distance_from_middle(mesh));
  EXPECT_EQ(order.depth(), Eigen::VectorXd::Zero(mesh.F.cols()));
  EXPECT_EQ(order.update(mesh.V), Eigen::VectorXd::Zero(mesh.F.cols()));
  EXPECT_EQ(order.report().regions, 0);
}

TEST(DepthOrder, PutsInFrontWhatThePredefinedOrderHasThere) {
  const Triangulation mesh = arms();
  const Eigen::Matrix2Xd V = dragged(mesh, -1.5);
  for (const bool b : {false, true}) {
    DepthOrder order(mesh, order_of(mesh, [b](const auto& p) { return b ? p[1] : -p[1]; }));
    order.update(V);
    EXPECT_EQ(b_in_front(order, mesh), b);
    EXPECT_EQ(order.report().regions, 1);
    EXPECT_EQ(order.report().lasting, 0);
    expect_stacked(order, mesh, V);
  }
}

TEST(DepthOrder, KeepsWhatIsInFrontUntilTheOverlapIsGone) {
  const Triangulation mesh = arms();
  DepthOrder order(mesh, order_of(mesh, [](const auto& p) { return p[1]; }));
  // Moves arm b across arm a in steps of half its width, then out on the other side.
  for (const double y : {-1.5, -2.5, -3.5, -4.5}) {
    order.update(dragged(mesh, y));
    EXPECT_TRUE(b_in_front(order, mesh)) << y;
    expect_stacked(order, mesh, dragged(mesh, y));
  }
  order.update(mesh.V);
  EXPECT_EQ(order.report().regions, 0);
}

TEST(DepthOrder, RemembersAcrossFramesAgainstThePredefinedOrder) {
  // The predefined order has arm b in front at its tip, and behind over its whole length. Whichever
  // overlap came first has to stay.
  const Triangulation mesh = arms();
  const Eigen::VectorXd order =
      order_of(mesh, [](const auto& p) { return p[1] < 2.5 ? 0.0 : (p[0] > 8.5 ? 1.0 : -1.0); });
  const auto laid = [&](double from) {  // arm b over arm a, where x > from
    return changed(mesh, [&](Eigen::Vector2d& p) {
      if (p[0] > from && p[1] > 2.5) p[1] -= 1.5;
    });
  };
  DepthOrder depths(mesh, order);
  depths.update(laid(3.5));
  ASSERT_FALSE(b_in_front(depths, mesh));
  depths.reset();
  for (const double from : {8.5, 7.5, 6.5, 5.5, 4.5, 3.5}) {
    depths.update(laid(from));
    EXPECT_TRUE(b_in_front(depths, mesh)) << from;
    EXPECT_EQ(depths.report().lasting, from == 8.5 ? 0 : 1);
    expect_stacked(depths, mesh, laid(from));
  }
  depths.update(mesh.V);
  depths.update(laid(3.5));  // the overlap was gone in between, so it is a new one
  EXPECT_FALSE(b_in_front(depths, mesh));
}

/// The share of interpenetration with depths at the vertices that never change, from which the
/// paper starts.
double static_share(const Triangulation& rest, const Eigen::Matrix2Xd& V,
                    const Eigen::VectorXd& order) {
  return interpenetration({V, rest.F}, OverlapFinder(rest)(V), vertex_depths(rest.F, order))
      .share();
}

TEST(DepthOrder, EndsTheInterpenetrationOfFigure7) {
  // Both arms have the same depths along them, so that they run through each other where they
  // cross.
  const Triangulation mesh = arms();
  const Eigen::VectorXd order = order_of(mesh, [](const auto& p) { return p[0]; });
  const Eigen::Matrix2Xd V = changed(mesh, [](Eigen::Vector2d& p) {
    if (p[0] < 2.5) return;
    const double angle = p[1] > 2.5 ? -0.4 : 0.4;
    const Eigen::Vector2d joint(2, p[1] > 2.5 ? 4 : 1);
    p = rotation(angle) * (p - joint) + joint;
  });
  EXPECT_GT(static_share(mesh, V, order), 0.1);
  DepthOrder depths(mesh, order);
  depths.update(V);
  EXPECT_EQ(interpenetration_of(depths, mesh, V), 0);
  EXPECT_GT(depths.overlaps().area, 1);
}

TEST(DepthOrder, EndsTheInterpenetrationOfFigure8) {
  // Depth rises along arm a from 0 to 2, and arm b lies across it at depth 1. So some edge of arm a
  // leads from behind arm b to before it.
  const Triangulation mesh = arms();
  const Eigen::VectorXd order =
      order_of(mesh, [](const auto& p) { return p[1] < 2.5 ? p[0] / 5 : 1.0; });
  const Eigen::Matrix2Xd V = dragged(mesh, -3.25);
  EXPECT_GT(static_share(mesh, V, order), 0.1);
  DepthOrder depths(mesh, order);
  depths.update(V);
  EXPECT_EQ(interpenetration_of(depths, mesh, V), 0);
}

/// Parts of 4 × 4 squares beside each other, which are all moved to nearly the same position.
struct Pile {
  Triangulation mesh;
  Eigen::Matrix2Xd V;
  Eigen::VectorXd order;  ///< #V, the number that was given for each part

  explicit Pile(const std::vector<double>& numbers) {
    const Triangulation one = sheet(5, 5);
    const auto n = static_cast<int>(one.V.cols());
    const Index parts = std::ssize(numbers);
    mesh = {Eigen::Matrix2Xd(2, n * parts), Eigen::Matrix3Xi(3, one.F.cols() * parts)};
    V = mesh.V;
    order.resize(n * parts);
    for (int k = 0; k < static_cast<int>(parts); ++k) {
      mesh.V.middleCols(n * k, n) = one.V.colwise() + Eigen::Vector2d(10 * k, 0);
      V.middleCols(n * k, n) = one.V.colwise() + Eigen::Vector2d(0.7 * k, 0.4 * k);
      mesh.F.middleCols(one.F.cols() * k, one.F.cols()) = one.F.array() + n * k;
      order.segment(n * k, n).setConstant(numbers[k]);
    }
  }
};

TEST(DepthOrder, StacksThreeSheets) {
  std::vector<double> numbers{1, 2, 3};
  do {
    const Pile pile(numbers);
    DepthOrder depths(pile.mesh, pile.order);
    const Eigen::VectorXd& depth = depths.update(pile.V);
    EXPECT_EQ(depths.report().regions, 3);
    EXPECT_EQ(depths.report().cyclic, 0);
    EXPECT_EQ(depth.maxCoeff(), 2);
    for (const TrianglePair& pair : depths.overlaps().pairs) {
      EXPECT_EQ(depth[pair.a] > depth[pair.b], numbers[pair.a / 32] > numbers[pair.b / 32]);
    }
    expect_stacked(depths, pile.mesh, pile.V);
  } while (std::ranges::next_permutation(numbers).found);
}

/// A ring of bars, each of which lies over the next.
TEST(DepthOrder, TakesBarsThatLieOverEachOtherInACircle) {
  constexpr int kBars = 4;
  const Triangulation bar = sheet(9, 3);
  const auto n = static_cast<int>(bar.V.cols());
  Triangulation mesh{Eigen::Matrix2Xd(2, n * kBars), Eigen::Matrix3Xi(3, bar.F.cols() * kBars)};
  Eigen::Matrix2Xd V = mesh.V;
  Eigen::VectorXd order(mesh.V.cols());
  for (int k = 0; k < kBars; ++k) {
    mesh.V.middleCols(n * k, n) = bar.V.colwise() + Eigen::Vector2d(0, 10 * k);
    mesh.F.middleCols(bar.F.cols() * k, bar.F.cols()) = bar.F.array() + n * k;
    // The end of each bar lies over the beginning of the next.
    V.middleCols(n * k, n) =
        rotation(k * std::numbers::pi / 2) * (bar.V.colwise() + Eigen::Vector2d(-3.5, -3.75));
    order.segment(n * k, n) = bar.V.row(0).transpose();
  }
  DepthOrder depths(mesh, order);
  depths.update(V);
  ASSERT_EQ(depths.report().regions, kBars);
  // No part of a bar lies in two regions, so that each end can lie over the next beginning.
  EXPECT_EQ(depths.report().cyclic, 0);
  expect_stacked(depths, mesh, V);
  for (const TrianglePair& pair : depths.overlaps().pairs) {
    const auto along = [&](int t) { return order(mesh.F.col(t)).mean(); };
    EXPECT_EQ(depths.depth()[pair.a] > depths.depth()[pair.b], along(pair.a) > along(pair.b));
  }
}

TEST(DepthOrder, ReportsWhatIsTwisted) {
  const auto [rest, V] = twisted_band(60);
  DepthOrder depths(rest, distance_from_middle(rest));
  depths.update(V);
  EXPECT_EQ(depths.report().twisted, 1);
  expect_stacked(depths, rest, V);
}

TEST(DepthOrder, StacksAnyDeformation) {
  const Triangulation mesh = triangulate(figure(), {.vertices = 200}, "figure");
  DepthOrder depths(mesh, distance_from_middle(mesh));
  std::mt19937 random(23);
  std::normal_distribution<double> normal;
  int overlapped = 0;
  for (int n = 0; n < 10; ++n) {
    const Eigen::Vector2d k = Eigen::Vector2d{normal(random), normal(random)} / 30;
    const Eigen::Vector2d u = 60 * Eigen::Vector2d{normal(random), normal(random)};
    for (const double t : {0.5, 0.7, 0.9}) {  // frames of one motion
      Eigen::Matrix2Xd V = mesh.V;
      for (auto p : V.colwise()) p += t * std::sin(k.dot(p)) * u;
      depths.update(V);
      overlapped += depths.report().regions > 0;
      expect_stacked(depths, mesh, V);
    }
  }
  EXPECT_GT(overlapped, 10);
}

TEST(DepthOrder, SharesNoDepthEvenWhereSheetsLieInCircles) {
  const Triangulation mesh = triangulate(figure(), {.vertices = 150}, "figure");
  DepthOrder depths(mesh, distance_from_middle(mesh));
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int cyclic = 0;
  for (int n = 0; n < 30; ++n) {
    Eigen::Matrix2Xd V = mesh.V;
    for (int wave = 0; wave < 3; ++wave) {
      const Eigen::Vector2d k = Eigen::Vector2d{normal(random), normal(random)} / 20;
      const Eigen::Vector2d u = 50 * Eigen::Vector2d{normal(random), normal(random)};
      for (Index i = 0; i < V.cols(); ++i) V.col(i) += std::sin(k.dot(mesh.V.col(i))) * u;
    }
    depths.update(V);
    cyclic += depths.report().cyclic;
    expect_stacked(depths, mesh, V);
  }
  EXPECT_GT(cyclic, 0);
}

TEST(DepthOrder, IsTheSameOnceMovedOrInAnotherUnit) {
  const Triangulation mesh = arms();
  DepthOrder plain(mesh, distance_from_middle(mesh));
  Triangulation large = mesh;
  large.V *= 0x1p30;
  DepthOrder scaled(large, distance_from_middle(large)), turned(mesh, distance_from_middle(mesh));
  for (const double y : {-1.35, -2.15, -3.35}) {
    const Eigen::Matrix2Xd V = dragged(mesh, y);
    const Eigen::VectorXd depth = plain.update(V);
    EXPECT_EQ(scaled.update(0x1p30 * V), depth);
    EXPECT_EQ(turned.update((rotation(1.1) * V).colwise() + Eigen::Vector2d(5, 6)), depth);
    EXPECT_EQ(plain.update(V), depth) << "the same frame twice";
  }
}

TEST(DepthOrder, DoesNotDependOnTheNumberingOfTriangles) {
  const Triangulation mesh = arms();
  Eigen::VectorXi order = Eigen::VectorXi::LinSpaced(mesh.F.cols(), 0, int(mesh.F.cols()) - 1);
  std::shuffle(order.begin(), order.end(), std::mt19937(9));
  const Triangulation other{mesh.V, mesh.F(Eigen::all, order)};
  const Eigen::VectorXd predefined = order_of(mesh, [](const auto& p) { return p[1]; });
  DepthOrder one(mesh, predefined), shuffled(other, predefined);
  const Eigen::Matrix2Xd V = dragged(mesh, -2.15);
  one.update(V);
  shuffled.update(V);
  for (const TrianglePair& pair : shuffled.overlaps().pairs) {
    EXPECT_EQ(shuffled.depth()[pair.a] > shuffled.depth()[pair.b],
              one.depth()[order[pair.a]] > one.depth()[order[pair.b]]);
  }
}

TEST(DepthOrder, HasThePredefinedRanksInATangle) {
  const Triangulation mesh = sheet(50, 50);
  DepthOrder depths(mesh, order_of(mesh, [](const auto& p) { return p[0]; }));
  const Eigen::VectorXd& depth = depths.update(shaken(mesh.V, 1e3, 4));
  EXPECT_FALSE(depths.report().found);
  for (Index t = 0; t < mesh.F.cols(); ++t) {
    for (const Index s : {Index(0), mesh.F.cols() / 2}) {
      const double here = mesh.V(0, mesh.F.col(t)).mean(), there = mesh.V(0, mesh.F.col(s)).mean();
      EXPECT_TRUE(here >= there || depth[t] < depth[s]);
    }
  }
  depths.update(mesh.V);  // the next update is not affected
  EXPECT_TRUE(depths.report().found);
  EXPECT_EQ(depths.depth(), Eigen::VectorXd::Zero(mesh.F.cols()));
}

TEST(DepthOrder, RefusesWhatDoesNotFitAndStaysAsItWas) {
  const Triangulation mesh = arms();
  EXPECT_THAT(error_of([&] { DepthOrder(mesh, Eigen::VectorXd::Zero(3)); }),
              HasSubstr("the order has 3 entries for 66 vertices"));
  Eigen::VectorXd order = Eigen::VectorXd::Zero(66);
  order[7] = NAN;
  EXPECT_THAT(error_of([&] { DepthOrder(mesh, order); }), HasSubstr("one finite number for each"));

  DepthOrder depths(mesh, distance_from_middle(mesh));
  const Eigen::VectorXd before = depths.update(dragged(mesh, -1.5));
  Eigen::Matrix2Xd V = mesh.V;
  V(0, 0) = NAN;
  EXPECT_THAT(error_of([&] { depths.update(V); }), HasSubstr("deformed vertex 0"));
  EXPECT_EQ(depths.depth(), before);
  EXPECT_EQ(depths.overlaps().regions.size(), 1u);
}

TEST(DistanceFromMiddle, GrowsTowardsTheEndsAndPutsLaterPartsBeforeEarlierOnes) {
  const Triangulation strip = sheet(21, 3);
  const Eigen::VectorXd order = distance_from_middle(strip);
  EXPECT_LT(order[21 + 10], 2);  // the middle
  EXPECT_NEAR(order[0], 10, 1);
  EXPECT_NEAR(order[20], 10, 1);
  const Pile pile({0, 0});
  const Eigen::VectorXd two = distance_from_middle(pile.mesh);
  EXPECT_GE(two.tail(25).minCoeff(), two.head(25).maxCoeff());
}

}  // namespace
}  // namespace deformlab::test
