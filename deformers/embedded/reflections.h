#pragma once

#include <Eigen/Core>

#include "deformers/deformer.h"
#include "geometry/graph/deformation_graph.h"
#include "solvers/solver.h"

namespace deformlab {

/// The number of nodes that turn space inside out, det R_j < 0, where a node is R_j and t_j,
/// d×(d+1).
int count_inside_out(const Unknowns& x);

/// If nodes are inside out, solves again from a better start. In space, these nodes are mirrored
/// along the normal of their neighbours, and the rotations of nodes that no handle follows are
/// spread evenly between those of the others, which unwinds twists. F is then minimised with the
/// term `orientation`, which pulls det R_j above 0, and from there without it. The result is a
/// minimum of F, or of F + orientation if nodes would turn over again because F has its least value
/// at a fold. The result is kept if fewer nodes are inside out than before. report.notes say what
/// was done.
///   graph, handles  in any common unit of length
///   solver          is compiled for the problem; the term is added for another one with `options`
void repair_reflections(Problem& problem, const DeformationGraph& graph, const Embedding& handles,
                        Solver& solver, const SolverOptions& options, Report& report);

}  // namespace deformlab
