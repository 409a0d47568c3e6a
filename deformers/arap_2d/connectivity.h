#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/plane/barycentric_point.h"
#include "geometry/plane/triangulation.h"

namespace deformlab {

/// A part of a mesh that shares no vertex with the rest. Indices are ascending.
struct MeshComponent {
  std::vector<int> vertices, triangles;

  bool contains(int vertex) const;
};

/// The connected components of a mesh, in the order of their first vertices.
std::vector<MeshComponent> components(const Triangulation& mesh);

/// The ascending indices of the points that lie in the component.
std::vector<int> points_inside(const MeshComponent& component,
                               const std::vector<BarycentricPoint>& points);

/// Weak triangles across hinges. Two parts of a mesh that share only a vertex could turn and scale
/// against each other at no cost in step one. One weak triangle between a triangle of each part
/// prevents this.
struct Hinges {
  Eigen::Matrix3Xi F;       ///< 3×#hinges vertices of the mesh
  Eigen::VectorXd weights;  ///< #hinges
};

/// Finds the hinges of a mesh. `weights` (#F) are the weights of its triangles.
Hinges hinges(const Triangulation& mesh, const Eigen::VectorXd& weights);

}  // namespace deformlab
