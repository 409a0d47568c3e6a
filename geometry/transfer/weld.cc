#include "geometry/transfer/weld.h"

#include <bit>
#include <cstdint>

namespace deformlab {
namespace {

// Adding zero turns -0 into +0, which is the same position.
std::uint64_t hash(const Eigen::Vector3d& p) {
  std::uint64_t h = 0;
  for (int i = 0; i < 3; ++i) {
    h = (h ^ std::bit_cast<std::uint64_t>(p[i] + 0.0)) * 0x9E3779B97F4A7C15;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

std::vector<int> weld(const Eigen::Matrix3Xd& V) {
  const auto count = static_cast<std::size_t>(V.cols());
  const std::size_t mask = std::bit_ceil(2 * count + 1) - 1;
  std::vector<int> slots(mask + 1, -1), first(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p = V.col(static_cast<Eigen::Index>(i));
    std::size_t at = hash(p) & mask;
    while (slots[at] >= 0 && V.col(slots[at]) != p) at = (at + 1) & mask;
    if (slots[at] < 0) slots[at] = static_cast<int>(i);
    first[i] = slots[at];
  }
  return first;
}

}  // namespace deformlab
