#pragma once

#include <vector>

#include "experiments/config/override.h"
#include "experiments/subjects/run.h"

namespace deformlab {

/// The number of the one run whose settings are those of `filter`. Throws InputError where none or
/// several are, or where `filter` is no map.
std::size_t find_reference(const ConfigNode& filter, const std::vector<SweptRun>& runs);

/// reference_rms and reference_max: how far the vertices are from where the reference has them, in
/// diagonals of the reference at rest. Throws InputError where it has others, or where there are
/// none.
Metrics difference(const Run& run, const Run& reference);

}  // namespace deformlab
