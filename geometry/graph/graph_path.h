#pragma once

#include "geometry/graph/deformation_graph.h"

namespace deformlab {

/// A graph whose nodes are the samples of a path in their order (3×m, m ≥ 1) [length]. Each node is
/// joined to the node before it and the node after it (Sumner et al. 2007, section 5, "Particle
/// simulations").
DeformationGraph path_graph(const Eigen::Matrix3Xd& samples);

}  // namespace deformlab
