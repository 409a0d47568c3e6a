#pragma once

#include <Eigen/Core>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Throws InputError for a mesh that the two steps cannot deform: it has no triangle, an index out
/// of range, a coordinate that is not finite or is too large, an edge of length 0, or a vertex in
/// no triangle. Also throws InputError for weights (one per triangle) that are not positive or
/// differ by more than a factor of 1e6.
void check_rest_mesh(const Triangulation& mesh, const Eigen::VectorXd& weights);

}  // namespace deformlab
