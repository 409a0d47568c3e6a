#pragma once

#include <vector>

#include "experiments/measure/measurements.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// How a drawing's mesh fares when its vertices come to V (2×#V):
///   area_ratio      its area over that at rest, triangles that are turned over counting negative
///   flipped         number of triangles that are turned over
///   arap            Σ ‖e'' − R e‖² over the edges e of all triangles, R the best rotation of each,
///                   over Σ ‖e‖²: what step two of Igarashi et al. 2005 lowers, at its own
///                   rotations
///   shear_mean, … stretch_max, edge_error_mean   as `distortion` says
Metrics plane_distortion(const Triangulation& rest, const Eigen::Matrix2Xd& V);

/// painted_shear_max and painted_stretch_max: over the triangles with a weight other than 1 (one
/// weight a triangle). Nothing where there are none.
Metrics painted_distortion(const Triangulation& rest, const Eigen::Matrix2Xd& V,
                           const Eigen::VectorXd& weights);

/// off_line_max: how far a vertex moves at right angles to the line through two places a and b, in
/// lengths between them (Igarashi et al. 2005, Figure 19).
Metrics off_line(const Triangulation& rest, const Eigen::Matrix2Xd& V, const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b);

}  // namespace deformlab
