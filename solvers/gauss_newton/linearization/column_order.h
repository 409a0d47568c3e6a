#pragma once

#include <vector>

#include "solvers/gauss_newton/linearization/node_blocks.h"

namespace deformlab {

/// A fill-reducing order, by minimum degree, of the n free columns of X: the column of rank
/// order[i] should come to position i. Neighbouring columns that have the same structure stay
/// together and count as one.
///   rank  of each column of X: 0 … n − 1, or −1 if it is not free
std::vector<int> column_order(const NodeBlocks& A, const std::vector<int>& rank, int n);

}  // namespace deformlab
