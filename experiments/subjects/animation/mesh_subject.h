#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// A mesh that moves: a generated gallop, or frames in files. They are read, edited and written one
/// by one, so that memory does not grow with their number. A command that was stopped continues
/// where it was. Its picture then shows all frames, but its metrics are only about the frames that
/// it made since, and a note says so. The metrics are those of SolveLog and MeshMeasurements,
/// vertices and handles, and for a command also frames.
SubjectKind mesh_animation_kind();

}  // namespace deformlab
