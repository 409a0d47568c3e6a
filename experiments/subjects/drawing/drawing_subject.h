#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// A drawing in the plane. Its metrics are those of run_of, plane_distortion, DrawingDepth,
/// painted_distortion, off_line and probe_metrics, and the number and quality of the triangles.
/// Names that begin with `intermediate.` are the plane_distortion of arap_2d's step one.
SubjectKind drawing_kind();

}  // namespace deformlab
