#pragma once

#include <map>
#include <string>

namespace deformlab {

/// What a figure depends on beside its config: versions of the program and its libraries, commit,
/// compiler and flags, processor, BLAS, threads.
std::map<std::string, std::string> environment();

}  // namespace deformlab
