#include "geometry/core/indices.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/core/error.h"

namespace deformlab {

void check_indices(std::span<const int> indices, std::ptrdiff_t count, std::string_view kind,
                   std::string_view what) {
  unsigned greatest = 0;  // a negative index becomes a great one; without a branch this is fast
  for (const int index : indices) greatest = std::max(greatest, static_cast<unsigned>(index));
  if (greatest < count || indices.empty()) return;
  for (const int index : indices) {
    if (index >= 0 && index < count) continue;
    throw InputError(
        fmt::format("{} name {} {} (counted from 0), but there are {}", what, kind, index, count));
  }
}

}  // namespace deformlab
