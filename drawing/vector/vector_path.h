#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace deformlab {

/// How an outline is filled or stroked.
struct Paint {
  enum class Kind { kNone, kColor, kLinear, kRadial };
  enum class Spread { kPad, kRepeat, kReflect };
  struct Stop {
    double offset;                ///< 0 … 1
    std::array<double, 4> color;  ///< straight sRGB and alpha, 0 … 1
  };
  Kind kind = Kind::kNone;
  Spread spread = Spread::kPad;
  std::vector<Stop> stops;  ///< one for kColor
  /// 2×3 or 2×4, the frame of a gradient. An affine motion of these points moves the gradient. A
  /// linear gradient has its begin, its end, and another point that has the colour of the begin. A
  /// radial one has its centre, the ends of two conjugate radii, and its focus.
  Eigen::Matrix2Xd points;
};

/// Consecutive cubic Bézier curves. Straight lines are cubics too, so that they can bend when their
/// control points move.
struct Curve {
  Eigen::Matrix2Xd points;  ///< 2×(3n+1) control points
  bool closed = false;      ///< whether the last point is the first, so that there are no caps
};

/// Outlines, and the rule that says what is inside.
struct Outlines {
  std::vector<Curve> curves;
  bool even_odd = false;  ///< false: the non-zero winding rule
};

/// One painted object of a vector drawing, in the drawing's coordinates.
struct VectorPath {
  Outlines outlines;
  Paint fill, stroke;
  double stroke_width = 0;  ///< [length]
  enum class Cap { kButt, kRound, kSquare } cap = Cap::kButt;
  enum class Join { kMiter, kRound, kBevel } join = Join::kMiter;
  double miter_limit = 4;
  std::vector<double> dashes;   ///< alternating lengths of dashes and gaps [length]
  double dash_offset = 0;       ///< [length]
  int number = -1;              ///< its place among all paths of its file, or −1
  std::vector<Outlines> clips;  ///< only what is inside all of these is painted
};

inline bool is_filled(const VectorPath& path) { return path.fill.kind != Paint::Kind::kNone; }
inline bool is_stroked(const VectorPath& path) {
  return path.stroke.kind != Paint::Kind::kNone && path.stroke_width > 0;
}

}  // namespace deformlab
