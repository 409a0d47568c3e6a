#pragma once

#include <Eigen/Core>

#include "deformers/embedded/embedded_deformation.h"

namespace deformlab {

/// The scene that solvers are measured on: a bumpy plane of unit side whose left strip is held and
/// whose right strip is lifted by half a side, all at once. Both strips are handles.
struct ReferenceScene {
  Shape shape;
  Handles handles;
  Eigen::Matrix3Xd targets;  ///< 3×#moved [length]
};

/// n×n vertices, strips of a twentieth of the columns.
ReferenceScene lifted_plane(int n);
/// 201×201 vertices, strips of ten columns: 4,020 handles.
const ReferenceScene& reference_scene();

/// n×n vertices over the unit square, z = 0.02 sin(10πx) sin(10πy), as quads, with unit normals.
Shape bumpy_plane(int n);

/// The scene with a graph of m nodes, the same for every solver, not compiled yet. With a `side`
/// its plane is that long and the energy is measured in its own unit: 2 makes a hard problem of it.
EmbeddedDeformation reference_deformation(int m, const SolverOptions& solver, double side = 0);

}  // namespace deformlab
