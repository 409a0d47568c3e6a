#include "geometry/shape/weld.h"

#include <bit>
#include <cstdint>

#include "geometry/core/disjoint_sets.h"
#include "geometry/core/hash.h"

namespace deformlab {
namespace {

// Adding zero turns -0 into +0, which is the same position.
std::uint64_t hash(const Eigen::Vector3d& p) {
  std::uint64_t h = 0;
  for (const double x : p) h = mixed(h, std::bit_cast<std::uint64_t>(x + 0.0));
  return h;
}

}  // namespace

std::vector<int> weld(const Eigen::Ref<const Eigen::Matrix3Xd>& V) {
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

const std::vector<int>& WeldedSurface::first() const {
  if (!first_) first_ = weld(shape_.V);
  return *first_;
}

int WeldedSurface::places() const {
  int count = 0;
  for (std::size_t i = 0; i < first().size(); ++i) count += first()[i] == static_cast<int>(i);
  return count;
}

Eigen::Matrix3Xi WeldedSurface::welded_triangles() const {
  const std::vector<int>& of_place = first();
  Eigen::Matrix3Xi T = triangles(shape_);
  for (int& i : T.reshaped()) i = of_place[i];
  return T;
}

std::vector<int> WeldedSurface::parts(const Eigen::Matrix3Xi& T) const {
  DisjointSets sets(shape_.V.cols());
  sets.join_corners(T);
  for (std::size_t i = 0; i < first().size(); ++i) sets.join(static_cast<int>(i), first()[i]);
  return sets.numbered();
}

}  // namespace deformlab
