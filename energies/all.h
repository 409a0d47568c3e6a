#pragma once

#include "energies/graph/constraint.h"
#include "energies/graph/orientation.h"
#include "energies/graph/regularization.h"
#include "energies/graph/rigid_constraint.h"
#include "energies/graph/rigid_regularization.h"
#include "energies/graph/rotation.h"
#include "energies/graph/smoothness.h"
#include "energies/triangle/edge_fit.h"
#include "energies/triangle/fitting.h"
#include "energies/triangle/point_constraint.h"
#include "energies/triangle/similarity.h"

namespace deformlab {

template <class... Term>
struct TermList {};

/// The terms over a deformation graph, in space (d = 3) and in the plane (d = 2). One that is named
/// here has a weight in configs, both solvers, a column in results and every law test.
template <int d>
using GraphTerms =
    TermList<Rotation<d>, Regularization<d>, Constraint<d>, Smoothness<d>, Orientation<d>>;

/// The same energy where nodes are rotations by construction (six unknowns): nothing is left of
/// E_rot.
using RigidTerms = TermList<RigidRegularization, RigidConstraint>;

/// The terms over a triangulation of the plane, held to the same laws; arap_2d minimises them.
using TriangleTerms = TermList<Similarity, Fitting, EdgeFit, PointConstraint>;

}  // namespace deformlab
