#pragma once

#include <map>
#include <string>

namespace deformlab {

/// What figures depend on besides the config: versions of the program and its libraries, commit,
/// compiler and flags, processor, BLAS, and threads.
std::map<std::string, std::string> environment();

}  // namespace deformlab
