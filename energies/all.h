#pragma once

#include "energies/constraint.h"
#include "energies/edge_fit.h"
#include "energies/fitting.h"
#include "energies/orientation.h"
#include "energies/place_constraint.h"
#include "energies/regularization.h"
#include "energies/rigid_constraint.h"
#include "energies/rigid_regularization.h"
#include "energies/rotation.h"
#include "energies/similarity.h"
#include "energies/smoothness.h"

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

/// The terms over a triangulation of the plane, held to the same laws; rigid_shape minimises them.
using TriangleTerms = TermList<Similarity, Fitting, EdgeFit, PlaceConstraint>;

}  // namespace deformlab
