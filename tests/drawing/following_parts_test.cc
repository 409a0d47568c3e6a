#include "drawing/following_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/drawings.h"

namespace deformlab {
namespace {

using test::grid_mesh;

/// A bar from (0, 0) to (100, 10).
const Triangulation kBar = grid_mesh(11, {0, 0}, {100, 10});

/// The bar bent into a quarter of a circle, with its left end in place.
Eigen::Matrix2Xd bent(const Eigen::Matrix2Xd& V) {
  const double radius = 200 / std::numbers::pi;
  Eigen::Matrix2Xd result(2, V.cols());
  for (Eigen::Index i = 0; i < V.cols(); ++i) {
    const double angle = V(0, i) / radius, r = radius - V(1, i);
    result.col(i) << r * std::sin(angle), radius - r * std::cos(angle);
  }
  return result;
}

/// The greatest change of a distance between two vertices of columns `first` to `last`.
double change_of_shape(const Eigen::Matrix2Xd& rest, const Eigen::Matrix2Xd& moved,
                       Eigen::Index first, Eigen::Index last) {
  double most = 0;
  for (Eigen::Index i = first; i <= last; ++i)
    for (Eigen::Index j = first; j < i; ++j)
      most = std::max(most, std::abs((moved.col(i) - moved.col(j)).norm() -
                                     (rest.col(i) - rest.col(j)).norm()));
  return most;
}

TEST(FollowingParts, StayWhereTheyAreWhenTheMeshDoes) {
  const FollowingParts parts(kBar, {grid_mesh(4, {103, -20}, {143, 30})});
  EXPECT_LT((parts(kBar.V) - parts.all().V).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FollowingParts, AHeadTurnsWithTheEndThatItSitsOnAndKeepsItsShape) {
  const FollowingParts parts(kBar, {grid_mesh(4, {103, -20}, {143, 30})});
  const Eigen::Matrix2Xd moved = parts(bent(kBar.V));
  const Eigen::Index n = kBar.V.cols();
  EXPECT_LT(change_of_shape(parts.all().V, moved, n, moved.cols() - 1), 1);
  const Eigen::Vector2d side = moved.col(n + 12) - moved.col(n);             // (0, 50) at rest
  EXPECT_NEAR(std::atan2(-side.x(), side.y()), std::numbers::pi / 2, 0.15);  // the end turned so
  const Eigen::Vector2d center = moved.rightCols(16).rowwise().mean();
  const double radius = 200 / std::numbers::pi;
  EXPECT_LT((center - Eigen::Vector2d(radius - 5, radius + 23)).norm(), 4);
}

TEST(FollowingParts, AStripeBesideALongLimbBendsWithIt) {
  const Triangulation stripe = grid_mesh(9, {10, 14}, {90, 18});
  const FollowingParts parts(kBar, {stripe});
  const Eigen::Matrix2Xd moved = parts(bent(kBar.V)).rightCols(81), wanted = bent(stripe.V);
  EXPECT_LT((moved - wanted).colwise().norm().maxCoeff(), 3);
}

TEST(FollowingParts, APartFollowsANearerPart) {
  const Triangulation head = grid_mesh(4, {103, -20}, {143, 30}),
                      hat = grid_mesh(3, {145, -20}, {160, 30});
  const FollowingParts parts(kBar, {hat, head});
  const Eigen::Matrix2Xd moved = parts(bent(kBar.V));
  EXPECT_LT(change_of_shape(parts.all().V, moved, kBar.V.cols(), moved.cols() - 1), 2);
}

TEST(FollowingParts, HaveTheDepthOfWhatTheyFollow) {
  const FollowingParts parts(kBar, {grid_mesh(4, {103, 0}, {143, 10})});
  Eigen::VectorXd depth = Eigen::VectorXd::Zero(kBar.F.cols());
  for (Eigen::Index f = 0; f < depth.size(); ++f) depth[f] = kBar.V(0, kBar.F(0, f)) >= 90;
  EXPECT_EQ(parts.depths(depth).tail(18), Eigen::VectorXd::Ones(18));
  EXPECT_EQ(parts.depths({}).size(), 0);
}

TEST(FollowingParts, VerySmallPartsGetNoMesh) {
  const auto square = [](double x, double size) {
    Region region{Eigen::Matrix2Xd(2, 4), {}};
    region.outline << x, x + size, x + size, x, 20, 20, 20 + size, 20 + size;
    return region;
  };
  EXPECT_EQ(meshes_of({square(0, 20), square(40, 0.1)}, kBar).size(), 1u);
}

}  // namespace
}  // namespace deformlab
