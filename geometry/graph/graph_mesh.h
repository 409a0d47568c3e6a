#pragma once

// This is shared by the code that reads a shape as a surface mesh of CGAL. No public header
// includes it.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <string>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

using MeshKernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<MeshKernel::Point_3>;

/// Some triangles of a shape as a mesh that has only the vertices of these triangles.
struct MeshPart {
  Mesh mesh;
  std::vector<int> vertices;  ///< the shape's vertex for each vertex of the mesh, ascending
};

/// Makes a mesh of the triangles T (3×#T) of a shape, which need not be connected. Throws
/// InputError where they do not form a manifold mesh. The message says that `wish` needs one.
MeshPart manifold_mesh(const Shape& shape, const Eigen::Matrix3Xi& T, const std::string& wish);

}  // namespace deformlab
