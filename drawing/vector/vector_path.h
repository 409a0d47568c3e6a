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
  /// The frame of a gradient, so that any affine motion of it is one of these points. Linear: from,
  /// to, and a second point of the line through `from` on which the colour stays. Radial: centre,
  /// the ends of two conjugate radii, and the focus.
  Eigen::Matrix2Xd points;
};

/// A run of cubic Bézier curves, straight lines among them too, so that a curve stays a curve when
/// its control points move.
struct Curve {
  Eigen::Matrix2Xd points;  ///< 2×(3n+1) control points
  bool closed = false;      ///< the last point is the first; painted without caps
};

/// Outlines and which side of them is inside.
struct Outlines {
  std::vector<Curve> curves;
  bool even_odd = false;  ///< else non-zero winding
};

/// One painted object of a vector drawing, in the drawing's coordinates.
struct VectorPath {
  Outlines outlines;
  Paint fill, stroke;
  double stroke_width = 0;  ///< [length]
  enum class Cap { kButt, kRound, kSquare } cap = Cap::kButt;
  enum class Join { kMiter, kRound, kBevel } join = Join::kMiter;
  double miter_limit = 4;
  std::vector<double> dashes;   ///< lengths of dashes and gaps in turn [length]
  double dash_offset = 0;       ///< [length]
  std::vector<Outlines> clips;  ///< painted only where it is inside of all of these
};

}  // namespace deformlab
