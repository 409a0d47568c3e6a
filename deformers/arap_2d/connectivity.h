#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/plane/triangulation.h"

namespace deformlab {

/// Throws InputError for a mesh that cannot be deformed rigidly: without triangles, with indices
/// out of range, coordinates that are not finite or an edge of length 0, with a vertex that no
/// triangle has; and for weights that are not one a triangle, positive and within a factor of 1e6.
void check(const Triangulation& mesh, const Eigen::VectorXd& weights);

/// What hangs together by shared vertices: ascending indices of vertices and triangles.
struct MeshComponent {
  std::vector<int> vertices, triangles;
};
std::vector<MeshComponent> components(const Triangulation& mesh);

/// Where parts meet in a vertex only, step one would let them turn and scale against each other
/// freely. A weak triangle between a triangle of either part ends that.
struct Hinges {
  Eigen::Matrix3Xi F;
  Eigen::VectorXd weights;
};
Hinges hinges(const Triangulation& mesh, const Eigen::VectorXd& weights);

}  // namespace deformlab
