#pragma once

#include <string>

#include "drawing/write_drawing.h"
#include "experiments/config/config_node.h"

namespace deformlab {

// `output.page` as a value of a config: `grow`, `keep`, `[x0, y0, x1, y1]`, or
// `{min: [x0, y0], max: [x1, y1]}` as in the box of a selection.

/// Throws InputError for anything else, for a box without an extent, and for coordinates beyond a
/// million.
void read_value(const ConfigNode& node, const std::string& name, OutputPage& page);
ConfigNode to_node(const OutputPage& page);

}  // namespace deformlab
