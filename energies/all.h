#pragma once

#include "energies/graph/constraint.h"
#include "energies/graph/orientation.h"
#include "energies/graph/regularization.h"
#include "energies/graph/rotation.h"
#include "energies/graph/smoothness.h"
#include "energies/triangle/arap.h"
#include "energies/triangle/area.h"
#include "energies/triangle/edge_fit.h"
#include "energies/triangle/fitting.h"
#include "energies/triangle/point_constraint.h"
#include "energies/triangle/similarity.h"
#include "energies/triangle/stretch_shear.h"
#include "energies/triangle/symmetric_dirichlet.h"

namespace deformlab {

/// Terms that are templates on the node model.
template <template <class> class... Term>
struct GraphTermList {};

/// Terms that are plain structs.
template <class... Term>
struct TermList {};

/// The terms over a deformation graph. A term in this list has a weight in configs and a column in
/// results, both solvers minimise it, and the tests check its laws, for each node model that it is
/// defined for.
using GraphTerms = GraphTermList<Rotation, Regularization, Constraint, Smoothness, Orientation>;

/// The elastic terms over a triangulation of the plane. They have weights in configs, and arap_2d
/// minimises them after its two steps.
using ElasticTerms = TermList<Arap, StretchShear, Area, SymmetricDirichlet>;

/// All terms over a triangulation, those of the two steps first. Tests check their laws.
using TriangleTerms = TermList<Similarity, Fitting, EdgeFit, PointConstraint, Arap, StretchShear,
                               Area, SymmetricDirichlet>;

}  // namespace deformlab
