#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/core/hash.h"

namespace deformlab {

/// A hash table from unordered pairs of triangles to numbers. Open addressing makes it fast,
/// because one update of the depths looks up hundreds of thousands of pairs.
class PairTable {
 public:
  static constexpr int kNone = -1;

  /// The number of the pair, or kNone where it has none.
  int find(int a, int b) const { return slots_.empty() ? kNone : slots_[place(key(a, b))].number; }
  /// The number that the pair already has. Otherwise gives it `number` (≥ 0) and returns kNone.
  int enter(int a, int b, int number) {
    if (2 * count_ >= slots_.size()) grow();
    Slot& slot = slots_[place(key(a, b))];
    if (slot.number != kNone) return slot.number;
    slot = {key(a, b), number};
    ++count_;
    return kNone;
  }
  void clear() {
    slots_.clear();
    count_ = 0;
  }

 private:
  struct Slot {
    std::uint64_t key;
    int number = kNone;
  };

  static std::uint64_t key(int a, int b) {
    const auto [low, high] = a < b ? std::pair(a, b) : std::pair(b, a);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
  }
  // The slot of the key, or the free one where it belongs. At least half of the 2ⁿ slots are free.
  std::size_t place(std::uint64_t of) const {
    for (std::size_t i = mixed(0, of);; ++i) {
      const std::size_t at = i & (slots_.size() - 1);
      if (slots_[at].number == kNone || slots_[at].key == of) return at;
    }
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 1024 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != kNone) slots_[place(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace deformlab
