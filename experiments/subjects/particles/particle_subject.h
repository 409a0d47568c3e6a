#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// Particles that come and go: a generated jet, or a table of particles in a file. The file that a
/// command writes has the rows of its input in the same order, and appears complete or not at all.
/// If the rows are in the order of frames, memory does not grow with their number. The metrics are
/// those of SolveLog, StreamMeasurements and twist_of, handles, vertices (the mean number of
/// particles in a frame), and node_motion, which is the mean distance by which the nodes move, as a
/// part of the diagonal of their bounding box. seconds.weights and seconds.transfer are the least
/// seconds for the particles of a frame.
SubjectKind particles_kind();

}  // namespace deformlab
