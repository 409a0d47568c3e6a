#include "geometry/plane/overlap/overlap_triangles.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

#include "geometry/plane/cross.h"

namespace deformlab {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

}  // namespace

int turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  // Corners that neighbours share would need exact arithmetic, which is slow.
  if (a == b || b == c || c == a) return 0;
  return CGAL::orientation(Kernel::Point_2(a[0], a[1]), Kernel::Point_2(b[0], b[1]),
                           Kernel::Point_2(c[0], c[1]));
}

// Returns false where all corners of the other triangle are outside an edge or on it.
bool MutualSides::sides_of(const TurnedTriangle& from, const TurnedTriangle& of,
                           std::array<Sides, 3>& sides) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int side = turn(from.corners.col(i), from.corners.col(next(i)), of.corners.col(j));
      sides[i][j] = static_cast<std::int8_t>(from.turn * side);
    }
    if (*std::ranges::max_element(sides[i]) <= 0) return false;
  }
  return true;
}

// Two triangles without a common inner point are separated by an edge of one of them.
std::optional<MutualSides> MutualSides::of_overlapping(const TurnedTriangle& a,
                                                       const TurnedTriangle& b) {
  MutualSides sides;
  if (!sides_of(a, b, sides.b_of_a_) || !sides_of(b, a, sides.a_of_b_)) return {};
  return sides;
}

bool MutualSides::enters(const Sides& others, const std::array<Sides, 3>& other_edges, int i) {
  const auto [least, most] = std::ranges::minmax(others);
  if (least >= 0 || most <= 0) return false;
  return std::ranges::none_of(
      other_edges, [&](const Sides& ends) { return ends[i] <= 0 && ends[next(i)] <= 0; });
}

bool share_a_length(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d) {
  const int axis = a[0] != b[0] ? 0 : 1;
  const auto [a_least, a_most] = std::minmax({a[axis], b[axis]});
  const auto [c_least, c_most] = std::minmax({c[axis], d[axis]});
  return std::max(a_least, c_least) < std::min(a_most, c_most);
}

ConvexPolygon clipped(const ConvexPolygon& polygon, const ConvexPolygonValues& values) {
  const Eigen::Index n = polygon.cols();
  ConvexPolygon kept(2, ConvexPolygon::MaxColsAtCompileTime);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index k = i + 1 == n ? 0 : i + 1;
    if (values[i] >= 0) kept.col(count++) = polygon.col(i);
    if ((values[i] < 0) == (values[k] < 0) || values[i] == 0 || values[k] == 0) continue;
    const double t = values[i] / (values[i] - values[k]);
    kept.col(count++) = (1 - t) * polygon.col(i) + t * polygon.col(k);
  }
  return kept.leftCols(count);
}

ConvexPolygon intersection(const TurnedTriangle& a, const TurnedTriangle& b) {
  ConvexPolygon polygon = a.corners;
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector2d start = b.corners.col(j);
    const Eigen::Vector2d along = b.turn * (b.corners.col((j + 1) % 3) - start);
    ConvexPolygonValues inside(polygon.cols());
    for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
      inside[i] = cross(along, polygon.col(i) - start);
    }
    polygon = clipped(polygon, inside);
  }
  return polygon;
}

double convex_area(const ConvexPolygon& polygon) {
  double twice = 0;
  for (Eigen::Index i = 2; i < polygon.cols(); ++i) {
    twice += cross(polygon.col(i - 1) - polygon.col(0), polygon.col(i) - polygon.col(0));
  }
  return std::abs(twice) / 2;
}

}  // namespace deformlab
