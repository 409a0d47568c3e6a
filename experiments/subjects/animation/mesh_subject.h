#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// A mesh that moves: a generated gallop, or frames in files, which are read, edited and written
/// one by one, so that memory does not grow with their number. A command that was stopped goes on
/// where it was; its picture then shows all frames, and its metrics are about the frames that were
/// made since, as a note in them says. The metrics are those of SolveLog and MeshMeasurements,
/// vertices and handles; those of a command also have frames.
SubjectKind mesh_animation_kind();

}  // namespace deformlab
