#pragma once

// What reads a shape as CGAL's surface mesh shares this; no public header includes it.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <string>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab {

using MeshKernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<MeshKernel::Point_3>;

/// Some triangles of a shape as a mesh, which has only the vertices that they use.
struct MeshPart {
  Mesh mesh;
  std::vector<int> vertices;  ///< of the shape, by the index of the mesh's vertex; ascending
};

/// The triangles T (3×#T) of a shape, none of which need be connected. Throws InputError where they
/// do not make a manifold mesh; `wish` is what the message says asked for one.
MeshPart manifold_mesh(const Shape& shape, const Eigen::Matrix3Xi& T, const std::string& wish);

}  // namespace deformlab
