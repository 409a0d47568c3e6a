#pragma once

#include <string>

namespace deformlab {

/// The BLAS that this process's linear algebra runs on, its library file and version: the one that
/// the dynamic linker really bound, whatever was asked for at build time.
std::string blas_name();

}  // namespace deformlab
