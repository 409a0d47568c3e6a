#pragma once

#include <Eigen/Core>

namespace deformlab {

/// Removes points (the columns of g, 3×#g [length]) until m remain. Of the two points that are
/// nearest to each other the later one is removed, again and again. The time grows as n log n.
void thin_out(Eigen::Matrix3Xd& g, int m);

}  // namespace deformlab
