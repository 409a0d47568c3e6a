#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace deformlab {

/// Throws InputError where one of the indices is not among 0 … count − 1. The message calls each of
/// them `kind`, such as "vertex", and all of them `what`, such as "the sources".
void check_indices(std::span<const int> indices, std::ptrdiff_t count, std::string_view kind,
                   std::string_view what);

}  // namespace deformlab
