#pragma once

#include <Eigen/Core>

#include "energies/unknowns.h"
#include "geometry/deformation_graph.h"

namespace deformlab {

/// The rotation that is nearest to R.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R);

/// Where nodes are inside out (det R_j < 0), a better place to solve on from: E_rot is content with
/// a reflection, and a flat patch of handles is too, so no step leads away from it. Those nodes are
/// mirrored back along the normal of their neighbours, which hardly moves a flat patch. Then the
/// rotations of the nodes that no handle follows are spread evenly between those of the others, and
/// their places follow the rotations (least squares over the edges).
///   graph  in the unit of x, 3×4m. Returns false, and changes nothing, where no node is inside
///   out.
bool turn_back(const DeformationGraph& graph, const Embedding& handles,
               const std::vector<char>& fixed, Unknowns& x);

}  // namespace deformlab
