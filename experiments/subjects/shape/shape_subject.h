#pragma once

#include "experiments/subjects/subject.h"

namespace deformlab {

/// A shape in space. Its metrics are those of run_of, distortion, region_distortion, detail,
/// stripes, probe_metrics and node_shear, and components.
SubjectKind shape_kind();

}  // namespace deformlab
