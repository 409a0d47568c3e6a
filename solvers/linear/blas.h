#pragma once

#include <string>

namespace deformlab {

/// The library file and version of the BLAS that this process uses. The dynamic linker chooses it,
/// so it may differ from the one that the program was built with.
std::string blas_name();

}  // namespace deformlab
