#pragma once

#include <string>

#include "deformers/embedded/presets.h"
#include "experiments/benchmarks/ab_runner.h"
#include "experiments/benchmarks/reference_scene.h"
#include "solvers/options.h"

namespace deformlab {

std::string describe(const SolverOptions& options);

SolverOptions cholmod_options();
SolverOptions ceres_options(const std::string& linear_solver, CeresBlocks blocks,
                            CeresTrustRegion trust_region,
                            CeresSparseLibrary sparse_library = CeresSparseLibrary::kSuiteSparse);

/// The result of a solve, with the time that is compared.
RunResult result_of(double ms, const Summary& solve);

/// Compilation and update from rest, without the transfer, which is the same for all solvers.
/// `side` is that of reference_deformation.
Way from_rest(int nodes, const SolverOptions& options, double side = 0);

/// The same with the transfer to all vertices, by the default solver.
Way with_transfer(int nodes);

/// A drag by 1 % of the side that follows another one, without the transfer.
Way drag(int nodes, const SolverOptions& options);

/// A drag of one of the armadillo's ten handles by 1 % of its size that follows another one, with
/// the transfer to all vertices and normals.
Way armadillo_drag(int nodes, const SolverOptions& options);

/// A drag as above with the graph, the weights and the start of a preset, and with the default
/// solver.
Way drag_with_preset(int nodes, Preset preset);

/// The reference scene with the graph, the weights and the start of a preset.
EmbeddedDeformation preset_deformation(int nodes, Preset preset);

/// A compilation of all handles at rest.
Way full_compilation(EmbeddedDeformation deformation);

/// A handle in the middle of the plane is added or removed, without the update: half the time that
/// both take together.
Way change_handle(EmbeddedDeformation deformation);

/// The update after such a handle was added and moved by 1 % of the side, without the transfer.
///   afresh  whether all handles are compiled instead
Way update_with_new_handle(EmbeddedDeformation deformation, bool afresh);

/// The mean time of a step of a solve from rest, without our compilation or Ceres' preprocessing.
Way step(int nodes, const SolverOptions& options);

/// CGAL's as-rigid-as-possible deformation of all vertices, until an iteration moves no vertex by
/// more than 1e-4 of the side.
Way cgal_arap_from_rest();

}  // namespace deformlab
