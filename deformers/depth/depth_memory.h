#pragma once

#include <vector>

#include "geometry/core/pair_table.h"
#include "geometry/plane/overlap/overlap.h"

namespace deformlab {

/// Remembers which triangles the last update showed in front, so that they stay there as long as
/// they overlap.
class DepthMemory {
 public:
  /// What is remembered of a region.
  struct Recollection {
    /// The area where its first sheet was in front minus the area where its second sheet was
    /// [length²].
    double vote = 0;
    bool lasting = false;  ///< some of its pairs of triangles overlapped in the last update too
    /// Its first sheet was in front in a part of these pairs and its second sheet in another one,
    /// as where two regions have become one.
    bool mixed = false;
  };

  /// What is remembered of each region. A region lasts if it shares pairs of triangles with the
  /// last update. An overlap that moved by more than its own width has only new pairs, and the
  /// region of its old pairs is gone. The triangles of a region that is gone therefore stay in
  /// front or behind in new regions.
  std::vector<Recollection> recall(const Overlaps& overlaps) const;

  /// +1 if triangle a was in front of b in the last update, −1 if it was behind, and 0 if they did
  /// not overlap.
  int side(int a, int b) const;

  /// Replaces what is remembered. `a_in_front` has one entry for each pair of triangles: whether
  /// its first triangle is in front.
  void keep(const Overlaps& overlaps, const std::vector<bool>& a_in_front);
  void forget() { keep({}, {}); }

 private:
  struct Seen {
    int front, back, region;
  };

  std::vector<int> sides_of_gone(const std::vector<bool>& gone) const;

  std::vector<Seen> seen_;
  PairTable index_;  ///< the index in seen_ of a pair of triangles
  std::size_t regions_ = 0;
  int triangles_ = 0;  ///< the greatest index of a triangle in seen_, plus one
};

}  // namespace deformlab
