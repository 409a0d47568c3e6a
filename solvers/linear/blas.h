#pragma once

#include <string>

namespace deformlab {

/// The BLAS that this process's linear algebra runs on: its library file and version. It is the one
/// that the dynamic linker bound, whatever was asked for when the program was built.
std::string blas_name();

}  // namespace deformlab
