#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/silhouette.h"

namespace deformlab {

/// Pixels with straight (not premultiplied) sRGB colour and alpha, rows from the top down.
struct Bitmap {
  int width = 0, height = 0;       ///< [pixel]
  std::vector<std::uint8_t> rgba;  ///< four bytes a pixel
};

/// How an outline is filled or stroked.
struct Paint {
  struct Stop {
    double offset;                ///< 0 … 1
    std::array<double, 4> color;  ///< straight sRGB and alpha, 0 … 1
  };
  enum class Kind { kNone, kColor, kLinear, kRadial };
  Kind kind = Kind::kNone;
  std::vector<Stop> stops;  ///< one for kColor
  /// Gradients: from and to; of a radial one the focus, the centre, and a point on the circle.
  Eigen::Matrix2Xd points;
};

/// A run of cubic Bézier curves: 2×(3n+1) control points, straight lines among them too, so that a
/// curve stays a curve when its control points move.
struct Curve {
  Eigen::Matrix2Xd points;
  bool closed = false;
};

/// One painted object of a vector drawing: its curves, in the drawing's coordinates.
struct VectorPath {
  std::vector<Curve> curves;
  Paint fill, stroke;
  double stroke_width = 0;  ///< [pixel]
  bool even_odd = false;
  int line_cap = 0, line_join = 0;  ///< as Cairo counts them
  double miter_limit = 10;
};

/// A drawing at rest: pixels, curves, or neither where only its outline was given. Coordinates are
/// pixels, x to the right, y down, the first pixel covering [0, 1] × [0, 1].
struct Drawing {
  double width = 0, height = 0;  ///< of the page [pixel]
  std::optional<Bitmap> bitmap;
  std::vector<VectorPath> paths;   ///< in the order in which they are painted
  Region region;                   ///< what the drawing covers
  std::vector<std::string> notes;  ///< what was decided on the way: background, parts left out
};

}  // namespace deformlab
