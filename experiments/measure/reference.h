#pragma once

#include <vector>

#include "experiments/config/override.h"
#include "experiments/subjects/subject.h"

namespace deformlab {

/// The index of the only run that has the settings of `filter`. Throws InputError if no run or
/// several runs have them, or if `filter` is not a map.
std::size_t find_reference(const ConfigNode& filter, const std::vector<SweptRun>& runs);

/// reference_rms and reference_max: the distance of the vertices from those of the reference, in
/// diagonals of the reference at rest. Throws InputError if the numbers of vertices differ, or if
/// there are none.
Metrics difference(const Run& run, const Run& reference);

}  // namespace deformlab
