#pragma once

#include <cstddef>
#include <vector>

namespace deformlab {

/// Items in an order from the back to the front, under constraints that one item lies in front of
/// another. A constraint that contradicts the order moves only those items in between that it
/// concerns (Pearce and Kelly 2006: A dynamic topological sort algorithm for directed acyclic
/// graphs), so that small changes cost little. The latest constraints can be removed again.
class DepthStack {
 public:
  /// The initial order: the items 0 … n − 1, each once.
  explicit DepthStack(std::vector<int> back_to_front);

  /// Adds the constraint that `front` lies in front of `back`. Returns false and adds nothing where
  /// it would close a cycle with earlier constraints, or where more than a few million items have
  /// been visited since the last `clear`.
  bool put(int back, int front);
  std::size_t constraints() const { return links_.size(); }
  /// Removes the latest constraints until `constraints` are left. The order stays as it is, because
  /// it satisfies the others too.
  void take_back_to(std::size_t constraints);
  /// Removes all constraints.
  void clear();

  bool in_front(int item, int of) const { return rank_[item] > rank_[of]; }

  /// For each item the length of the longest chain of constraints behind it, 0 where there is none.
  std::vector<int> heights() const;

 private:
  struct Link {
    int back, front;
    int next_front, next_back;  ///< the next link with the same `back`, and with the same `front`
  };

  bool gather_in_front(int from, int until);
  void gather_behind(int from, int until);
  void reorder();
  bool visit(int item, std::vector<int>& found);

  std::vector<int> back_to_front_;  ///< the order
  std::vector<int> rank_;           ///< the rank of each item in the order, 0 at the back
  std::vector<Link> links_;         ///< the constraints in the order in which they were added
  std::vector<int> first_front_, first_back_;  ///< each item's latest link to its front or back
  std::vector<int> in_front_, behind_;         ///< what the current `put` has found
  std::vector<char> visited_;
  int visits_ = 0;  ///< since the last `clear`
};

}  // namespace deformlab
