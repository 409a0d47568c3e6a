#pragma once

#include "geometry/graph/deformation_graph.h"

namespace deformlab {

/// A graph of samples along a path, in order (3×m, m ≥ 1) [length], each joined to the one before
/// and the one after it (Sumner et al. 2007, section 5, "Particle simulations").
DeformationGraph path_graph(const Eigen::Matrix3Xd& samples);

}  // namespace deformlab
