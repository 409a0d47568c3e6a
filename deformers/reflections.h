#pragma once

#include <Eigen/Core>
#include <memory>

#include "deformers/deformer.h"
#include "solvers/solver.h"

namespace deformlab {

/// The rotation that is nearest to R.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& R);

/// Nodes that turn space inside out, det R_j < 0; a node is R_j and t_j, d×(d+1).
int count_inside_out(const Unknowns& x);

/// Where nodes are inside out, solves on with the term `orientation` added, which draws det R_j up
/// to above 0, and then without it. What comes out is a minimum of F; only where nodes would turn
/// over again, because a fold is what F is least at, it is one of F + orientation. Kept where fewer
/// nodes are inside out than before, and said in report.notes.
///   orientation  over the nodes of the stage
///   solver       compiled for the stage; one more, of these options, is made for the added term.
void repair_reflections(Stage& stage, std::unique_ptr<Energy> orientation, Solver& solver,
                        const SolverOptions& options, Report& report);

}  // namespace deformlab
