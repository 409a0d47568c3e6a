#pragma once

#include "experiments/measure/measurements.h"

namespace deformlab {

/// stripes: how striped a bent plane is across its x axis [degree] (Sumner et al. 2007, Figure 5).
/// Its slope along x, atan2(Δz, Δx) from a column of vertices to the next, is averaged over the
/// rows, which leaves what runs across the whole plane; less its mean over a window of columns,
/// which takes the bending itself away; root mean square over the columns.
///   V  3×(columns·rows) vertices, row by row; window  odd, 3 … columns − 1
/// Throws InputError for a window out of range.
Metrics stripes(const Eigen::Matrix3Xd& V, int columns, int window);

}  // namespace deformlab
