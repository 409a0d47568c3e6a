#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace deformlab {

using TriangleCorners = Eigen::Matrix<double, 2, 3>;

/// A convex polygon, 2×n corners. Three corners that are clipped four times are thirteen at most,
/// even where rounding bends an edge.
using ConvexPolygon = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 13>;
using ConvexPolygonValues = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 13, 1>;

/// +1 where a, b, c turn from x to y, −1 the other way, 0 where they are on one line; exact.
int turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// A triangle and the way it turns, which is not 0.
struct TurnedTriangle {
  TriangleCorners corners;
  int turn;
};

/// How two triangles a and b lie to each other, by exact signs. Edge i runs from corner i to the
/// next.
class MutualSides {
 public:
  /// Nothing where the triangles have no area in common.
  static std::optional<MutualSides> of_overlapping(const TurnedTriangle& a,
                                                   const TurnedTriangle& b);
  /// Does edge i of a run through the inside of b?
  bool a_enters(int i) const { return enters(b_of_a_[i], a_of_b_, i); }
  /// Does edge j of b run through the inside of a?
  bool b_enters(int j) const { return enters(a_of_b_[j], b_of_a_, j); }
  /// Does edge i of a cross edge j of b, at one place that is the end of neither?
  bool cross(int i, int j) const {
    return b_of_a_[i][j] * b_of_a_[i][next(j)] < 0 && a_of_b_[j][i] * a_of_b_[j][next(i)] < 0;
  }
  /// Is edge i of a on one line with edge j of b?
  bool on_one_line(int i, int j) const { return b_of_a_[i][j] == 0 && b_of_a_[i][next(j)] == 0; }

 private:
  using Sides = std::array<std::int8_t, 3>;
  static int next(int i) { return i == 2 ? 0 : i + 1; }
  static bool sides_of(const TurnedTriangle& from, const TurnedTriangle& of,
                       std::array<Sides, 3>& sides);
  static bool enters(const Sides& others, const std::array<Sides, 3>& other_edges, int i);

  std::array<Sides, 3> b_of_a_;  ///< [i][j]: corner j of b lies inside (+1) edge i of a, on it (0)
  std::array<Sides, 3> a_of_b_;  ///< [j][i]: corner i of a, of edge j of b
};

/// Do the segments, which lie on one line, share more than a point?
bool share_a_length(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d);

/// What is left of a polygon where a function that is linear on it, and has these values (#n) at
/// its corners, is at least 0.
ConvexPolygon clipped(const ConvexPolygon& polygon, const ConvexPolygonValues& values);

/// What both triangles cover, turning as a does.
ConvexPolygon intersection(const TurnedTriangle& a, const TurnedTriangle& b);

/// Its area, whichever way it turns [length²].
double convex_area(const ConvexPolygon& polygon);

}  // namespace deformlab
