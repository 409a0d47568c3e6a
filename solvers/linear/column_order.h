#pragma once

#include <vector>

#include "solvers/gauss_newton/node_blocks.h"

namespace deformlab {

/// A fill-reducing order, by minimum degree, of those columns of X that have a rank (0 … n − 1; the
/// others −1): that of rank order[i] should come to place i. Columns of the same structure stay
/// together and count as one.
std::vector<int> column_order(const NodeBlocks& A, const std::vector<int>& rank, int n);

}  // namespace deformlab
