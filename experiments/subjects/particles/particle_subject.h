#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// Particles that come and go: a generated jet, or a table of particles in a file. The file that a
/// command writes has the rows of its input, in their order, and appears whole or not at all. Where
/// the rows are in the order of frames, memory does not grow with their number. The metrics are
/// those of SolveLog, StreamMeasurements and twist_of, handles, vertices (the mean number of
/// particles in a frame), and node_motion: the mean distance by which the nodes move, as a part of
/// the diagonal of their bounding box. The seconds of a frame's particles, seconds.weights and
/// seconds.transfer, are the least of all frames.
SubjectKind particles_kind();

}  // namespace deformlab
