#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace deformlab {

using TriangleCorners = Eigen::Matrix<double, 2, 3>;

/// A convex polygon, 2×n corners. A triangle that is clipped four times has at most 13 corners,
/// even where rounding bends an edge.
using ConvexPolygon = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 13>;
using ConvexPolygonValues = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 13, 1>;

/// The exact sign of the orientation of a, b, c: +1 where they turn from x to y, 0 where they are
/// on one line.
int turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// A triangle and the sign of its orientation, which is not 0.
struct TurnedTriangle {
  TriangleCorners corners;
  int turn;
};

/// The relative position of two overlapping triangles a and b, by exact signs. Edge i runs from
/// corner i to the next one.
class MutualSides {
 public:
  /// Returns nothing where the triangles have no area in common.
  static std::optional<MutualSides> of_overlapping(const TurnedTriangle& a,
                                                   const TurnedTriangle& b);
  /// Whether edge i of a runs through the inside of b.
  bool a_enters(int i) const { return enters(b_of_a_[i], a_of_b_, i); }
  /// Whether edge j of b runs through the inside of a.
  bool b_enters(int j) const { return enters(a_of_b_[j], b_of_a_, j); }
  /// Whether edge i of a crosses edge j of b at one point that is an end of neither.
  bool cross(int i, int j) const {
    return b_of_a_[i][j] * b_of_a_[i][next(j)] < 0 && a_of_b_[j][i] * a_of_b_[j][next(i)] < 0;
  }
  /// Whether edge i of a is on one line with edge j of b.
  bool on_one_line(int i, int j) const { return b_of_a_[i][j] == 0 && b_of_a_[i][next(j)] == 0; }

 private:
  using Sides = std::array<std::int8_t, 3>;
  static int next(int i) { return i == 2 ? 0 : i + 1; }
  static bool sides_of(const TurnedTriangle& from, const TurnedTriangle& of,
                       std::array<Sides, 3>& sides);
  static bool enters(const Sides& others, const std::array<Sides, 3>& other_edges, int i);

  std::array<Sides, 3> b_of_a_;  ///< [i][j]: +1 where corner j of b is inside edge i of a, 0 on it
  std::array<Sides, 3> a_of_b_;  ///< [j][i]: +1 where corner i of a is inside edge j of b, 0 on it
};

/// Whether the segments ab and cd, which lie on one line, share more than a point.
bool share_a_length(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d);

/// The part of a polygon where a linear function with these values (n) at its corners is ≥ 0.
ConvexPolygon clipped(const ConvexPolygon& polygon, const ConvexPolygonValues& values);

/// The area that both triangles cover, with the orientation of a.
ConvexPolygon intersection(const TurnedTriangle& a, const TurnedTriangle& b);

/// The area of a polygon of either orientation [length²].
double convex_area(const ConvexPolygon& polygon);

}  // namespace deformlab
