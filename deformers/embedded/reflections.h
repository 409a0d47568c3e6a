#pragma once

#include <Eigen/Core>

#include "deformers/deformer.h"
#include "geometry/graph/deformation_graph.h"
#include "solvers/solver.h"

namespace deformlab {

/// The rotation that is nearest to R.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R);

/// Nodes that turn space inside out, det R_j < 0; a node is R_j and t_j, d×(d+1).
int count_inside_out(const Unknowns& x);

/// Where nodes are inside out, a better place is taken to solve on from: in space they are mirrored
/// back along the normal of their neighbours, and the rotations of nodes that no handle follows are
/// spread evenly between those of the others. That unwinds twists. F is then minimised with the
/// term `orientation` added, which draws det R_j up to above 0, and from there without it. What
/// comes out is a minimum of F; only where nodes would turn over again, because a fold is what F is
/// least at, it is one of F + orientation. It is kept where fewer nodes are inside out than before,
/// and report.notes say what was done.
///   graph   in any unit, as the handles embedded in it
///   solver  compiled for the problem; another, of these options, is made for the added term.
void repair_reflections(Problem& problem, const DeformationGraph& graph, const Embedding& handles,
                        Solver& solver, const SolverOptions& options, Report& report);

}  // namespace deformlab
