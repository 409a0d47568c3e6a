#include "deformers/depth/depth_memory.h"

#include <algorithm>

namespace deformlab {
namespace {

constexpr double kMixed = 0.05;  // the least share of the smaller part

}  // namespace

std::vector<DepthMemory::Recollection> DepthMemory::recall(const Overlaps& overlaps) const {
  std::vector<Recollection> result(overlaps.regions.size());
  std::vector<bool> gone(regions_, true);
  for (std::size_t r = 0; r < result.size(); ++r) {
    double first = 0, second = 0;  // areas where each sheet was in front
    for (const TrianglePair& pair : overlaps.pairs_of(overlaps.regions[r])) {
      const int found = index_.find(pair.a, pair.b);
      if (found == PairTable::kNone) continue;
      const Seen& seen = seen_[found];
      (seen.front == pair.a ? first : second) += pair.area;
      result[r].lasting = true;
      gone[seen.region] = false;
    }
    result[r].vote = first - second;
    result[r].mixed = std::min(first, second) > kMixed * (first + second);
  }
  const std::vector<int> side = sides_of_gone(gone);
  const auto side_of = [&](int t) { return t < triangles_ ? side[t] : 0; };
  for (std::size_t r = 0; r < result.size(); ++r) {
    if (result[r].lasting) continue;
    for (const TrianglePair& pair : overlaps.pairs_of(overlaps.regions[r])) {
      result[r].vote += pair.area * (side_of(pair.a) - side_of(pair.b));
    }
  }
  return result;
}

int DepthMemory::side(int a, int b) const {
  const int found = index_.find(a, b);
  if (found == PairTable::kNone) return 0;
  return seen_[found].front == a ? 1 : -1;
}

// For each triangle +1 if it was mostly in front in regions that are gone, and −1 if it was mostly
// behind.
std::vector<int> DepthMemory::sides_of_gone(const std::vector<bool>& gone) const {
  std::vector<int> side(triangles_, 0);
  for (const Seen& seen : seen_) {
    if (!gone[seen.region]) continue;
    ++side[seen.front];
    --side[seen.back];
  }
  for (int& s : side) s = std::clamp(s, -1, 1);
  return side;
}

void DepthMemory::keep(const Overlaps& overlaps, const std::vector<bool>& a_in_front) {
  seen_.clear();
  index_.clear();
  triangles_ = 0;
  regions_ = overlaps.regions.size();
  for (std::size_t r = 0; r < regions_; ++r) {
    for (const auto& [a, b, area] : overlaps.pairs_of(overlaps.regions[r])) {
      const bool front = a_in_front[seen_.size()];
      index_.enter(a, b, static_cast<int>(seen_.size()));
      seen_.push_back({front ? a : b, front ? b : a, static_cast<int>(r)});
      triangles_ = std::max({triangles_, a + 1, b + 1});
    }
  }
}

}  // namespace deformlab
