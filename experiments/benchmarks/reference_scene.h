#pragma once

#include <Eigen/Core>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// A scene on which solvers are measured, such as a bumpy plane of unit side. Its left strip stays
/// in place and its right strip is lifted by half a side at once. The vertices of both strips are
/// handles.
struct ReferenceScene {
  Shape shape;
  Handles handles;
  Eigen::Matrix3Xd targets;  ///< 3×#moved [length]
};

/// The scene with n×n vertices. A strip has a twentieth of the columns.
ReferenceScene lifted_plane(int n);
/// The scene with 201×201 vertices and strips of ten columns, which are 4,020 handles.
const ReferenceScene& reference_scene();

/// n×n vertices over the unit square, z = 0.02 sin(10πx) sin(10πy), as quads, with unit normals.
Shape bumpy_plane(int n);

/// The scene with a graph of m nodes, which are the same for every solver. It is not compiled yet.
/// A `side` above 0 is the length of the plane [length], while the energy keeps the unit 1, so that
/// a side of 2 makes a harder problem.
EmbeddedDeformation reference_deformation(int m, const SolverOptions& solver, double side = 0);

/// CGAL's armadillo, of 26,002 vertices, with ten of them as handles, which are far from each
/// other. One of them is pulled away by a tenth of the size. Throws InputError where libcgal-demo
/// is not installed.
const ReferenceScene& armadillo_scene();

}  // namespace deformlab
