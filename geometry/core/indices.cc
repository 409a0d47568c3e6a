#include "geometry/core/indices.h"

#include <fmt/format.h>

#include "geometry/core/error.h"

namespace deformlab {

void check_indices(std::span<const int> indices, std::ptrdiff_t count, std::string_view kind,
                   std::string_view what) {
  for (const int index : indices) {
    if (index >= 0 && index < count) continue;
    throw InputError(
        fmt::format("{} name {} {} (counted from 0), but there are {}", what, kind, index, count));
  }
}

}  // namespace deformlab
