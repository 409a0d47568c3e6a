#pragma once

#include <vector>

namespace deformlab {

/// Which vertices of a shape the user holds (Sumner et al. 2007, section 4). Where the moved ones
/// go is not here: targets change with every update, handles only with a compilation.
struct Handles {
  std::vector<int> fixed;  ///< fixed constraints: every node that influences one is held at rest
  std::vector<int> moved;  ///< handle constraints, index(l) of Eq. 8, in the order of the targets
};

}  // namespace deformlab
