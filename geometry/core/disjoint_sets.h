#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <vector>

namespace deformlab {

/// The sets of elements 0 … n − 1 that have been joined (union–find with path halving). The
/// smallest element of a set is its root, so that the roots do not depend on the order of the
/// joins. Boost's disjoint_sets, which link by rank, do not provide that.
class DisjointSets {
 public:
  /// n sets of one element each.
  explicit DisjointSets(Eigen::Index n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The smallest element of the set that i is in.
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Makes one set of the sets of i and j. Returns false where they were one set already.
  bool join(int i, int j) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    parent_[high] = low;
    return low != high;
  }

  /// Makes one set of the corners of each triangle (3×#).
  void join_corners(const Eigen::Ref<const Eigen::Matrix3Xi>& triangles) {
    for (const auto t : triangles.colwise()) {
      join(t[0], t[1]);
      join(t[0], t[2]);
    }
  }

  /// The number of each element's set; sets are numbered from 0 in the order of their roots.
  std::vector<int> numbered() {
    std::vector<int> number(parent_.size());
    int count = 0;
    for (int i = 0; i < static_cast<int>(number.size()); ++i) {
      const int first = root(i);
      number[i] = first == i ? count++ : number[first];
    }
    return number;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace deformlab
