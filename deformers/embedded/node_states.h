#pragma once

#include <limits>

#include "energies/graph/context.h"
#include "energies/unknowns.h"
#include "geometry/transfer/transfer.h"

namespace deformlab {

/// The unknowns of m nodes at rest: R_j = I and t_j = 0, side by side. A node has d+1 columns, or
/// two if it is rigid.
Unknowns rest_states(NodeModel model, int d, int m);

/// The transformations (3×4m) of the unknowns. `unit` is the problem's unit of length, measured in
/// the unit of the transformations.
Transformations to_transformations(const Unknowns& x, NodeModel model, double unit);

/// Sets the unknowns of the nodes that are not fixed to these transformations. A rigid node takes
/// the nearest rotation.
void set_transformations(const Transformations& X, NodeModel model, double unit,
                         const std::vector<char>& fixed, Unknowns& x);

/// The rotation that is nearest to R.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R);

/// The determinants of the matrices R of some transformations.
struct Determinants {
  double least = std::numeric_limits<double>::infinity();
  int inside_out = 0;  ///< how many are below 0: space is turned inside out
};
Determinants determinants(const Transformations& X);

}  // namespace deformlab
