#pragma once

#include <cstddef>
#include <vector>

#include "solvers/problem.h"

namespace deformlab {

/// Throws InputError unless a solver has compiled a problem that has the same nodes and number of
/// terms as this one.
///   first  Unknowns::first of the compiled problem; null if none was compiled
///   terms  the number of its terms
void check_compiled(const Problem& problem, const std::vector<int>* first, std::size_t terms);

}  // namespace deformlab
