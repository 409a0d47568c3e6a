#pragma once

#include "drawing/vector/vector_path.h"

namespace deformlab {

/// The polygon through the corners (2×n). Each side is a straight cubic. A closed polygon returns
/// to its first corner.
Curve polygon(const Eigen::Matrix2Xd& corners, bool closed = true);

/// The curve with a straight cubic from its end to its beginning, unless it is closed.
Curve closed(Curve curve);

/// A cubic Bézier curve by its control points.
using Cubic = Eigen::Matrix<double, 2, 4>;

/// The part of a cubic from parameter s to t. It goes backwards if t is less than s.
Cubic part(const Cubic& cubic, double s, double t);

/// The same curve with fewer pieces: neighbouring ones become one cubic if it differs from them by
/// no more than `tolerance` [length].
Curve merged(const Curve& curve, double tolerance);

/// The same curve, cut into pieces whose control polygons are no longer than `longest` [length].
Curve cut(const Curve& curve, double longest);

/// A fill or stroke of one colour (straight sRGB and alpha, 0 … 1).
Paint one_color(const std::array<double, 4>& color);

}  // namespace deformlab
