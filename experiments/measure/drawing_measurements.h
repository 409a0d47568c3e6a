#pragma once

#include <vector>

#include "experiments/measure/measurements.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Measures the deformation of a drawing's mesh whose vertices are at V (2×#V):
///   area_ratio      its area over that at rest; the area of a flipped triangle is negative
///   flipped         number of flipped triangles
///   arap            Σ ‖e'' − R e‖² over the edges e of all triangles, R the best rotation of each,
///                   over Σ ‖e‖². Step two of Igarashi et al. 2005 lowers the same sum, with the
///                   rotations of step one
///   shear_mean, shear_max, stretch_mean, stretch_max, edge_error_mean   see `distortion`
Metrics plane_distortion(const Triangulation& rest, const Eigen::Matrix2Xd& V);

/// painted_shear_max and painted_stretch_max, over the triangles whose weight is not 1. `weights`
/// has one entry for each triangle. The result is empty if there is no such triangle.
Metrics painted_distortion(const Triangulation& rest, const Eigen::Matrix2Xd& V,
                           const Eigen::VectorXd& weights);

/// off_line_max: the greatest distance that a vertex moves at right angles to the line through the
/// points a and b, as a multiple of the distance between them (Igarashi et al. 2005, Figure 19).
Metrics off_line(const Triangulation& rest, const Eigen::Matrix2Xd& V, const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b);

}  // namespace deformlab
