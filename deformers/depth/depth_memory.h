#pragma once

#include <vector>

#include "geometry/core/pair_table.h"
#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// What the last update showed in front, so that it stays there while the overlap lasts.
class DepthMemory {
 public:
  /// What is remembered of a region.
  struct Recollection {
    double vote = 0;       ///< area where its first sheet was in front less where its second was
    bool lasting = false;  ///< some of its pairs of triangles overlapped already
  };

  /// Of each region. One that shares pairs of triangles with the last update lasts. A region all of
  /// whose pairs are new may still go on where an overlap that moved by more than its width left
  /// off: where one is gone, pairs and all, its triangles stay in front or behind.
  std::vector<Recollection> recall(const Overlaps& overlaps) const;

  /// Replaces what is remembered; `a_in_front` says it for each pair.
  void keep(const Overlaps& overlaps, const std::vector<bool>& a_in_front);
  void forget() { keep({}, {}); }

 private:
  struct Seen {
    int front, back, region;
  };

  std::vector<int> sides_of_gone(const std::vector<bool>& gone) const;

  std::vector<Seen> seen_;
  PairTable index_;  ///< in seen_
  std::size_t regions_ = 0;
  int triangles_ = 0;  ///< all seen have lower numbers
};

}  // namespace deformlab
