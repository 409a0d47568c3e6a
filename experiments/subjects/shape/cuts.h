#pragma once

#include <vector>

#include "experiments/config/config_node.h"
#include "geometry/graph/graph_cut.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// Reads the list under `cut:`. Each entry is {between: SELECTION, and: SELECTION} with the
/// selections of an edit. Then no node of the graph influences both parts, and no edge joins them
/// (Sumner et al. 2007, section 6: the stroke between a hand and a leg). Throws InputError (naming
/// the line) if an entry does not have two selections, or if one selects nothing.
std::vector<Cut> resolve_cuts(const ConfigNode& list, const Shape& rest);

/// Throws the InputError that resolve_cuts would throw for the list itself.
void check_cuts(const ConfigNode& list);

}  // namespace deformlab
