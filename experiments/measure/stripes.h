#pragma once

#include "experiments/measure/measurements.h"

namespace deformlab {

/// stripes: the strength of stripes across the x axis of a bent plane [degree] (Sumner et al. 2007,
/// Figure 5). The slope along x from a column of vertices to the next, atan2(Δz, Δx), is averaged
/// over the rows, so that only stripes across the whole plane remain. Then the mean slope in a
/// window of columns is subtracted, so that the bending itself does not count. The result is the
/// root mean square over the columns.
///   V       3×(columns·rows) vertices, row by row
///   window  an odd number from 3 to columns − 1
/// Throws InputError for a window out of range.
Metrics stripes(const Eigen::Matrix3Xd& V, int columns, int window);

}  // namespace deformlab
