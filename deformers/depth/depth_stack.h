#pragma once

#include <cstddef>
#include <vector>

namespace deformlab {

/// Items in an order from the back to the front, under constraints that one lies in front of
/// another. A constraint against the order moves the few items in between that it concerns (Pearce
/// and Kelly 2006: A dynamic topological sort algorithm for directed acyclic graphs), so where
/// little changes little is done. What was put later can be taken back.
class DepthStack {
 public:
  /// Items 0 … n − 1, each once.
  explicit DepthStack(std::vector<int> back_to_front);

  /// False, and nothing is put, where it would close a circle with those put before, or where more
  /// than a few million items had to be looked at since the last `clear`.
  bool put(int back, int front);
  std::size_t constraints() const { return links_.size(); }
  /// Takes back the latest, until as many are left. The order stays: it suits these too.
  void take_back_to(std::size_t constraints);
  /// Takes back all.
  void clear();

  bool in_front(int item, int of) const { return place_[item] > place_[of]; }

  /// Of each item the length of the longest chain of constraints behind it: 0 where none is.
  std::vector<int> heights() const;

 private:
  struct Link {
    int back, front;
    int next_front, next_back;  ///< the next link with the same `back`, with the same `front`
  };

  bool gather_in_front(int from, int until);
  void gather_behind(int from, int until);
  void reorder();
  bool visit(int item, std::vector<int>& found);

  std::vector<int> back_to_front_, place_;     ///< inverse to each other
  std::vector<Link> links_;                    ///< in the order in which they were put
  std::vector<int> first_front_, first_back_;  ///< an item's latest link to its front, to its back
  std::vector<int> in_front_, behind_;         ///< found by the current `put`
  std::vector<char> visited_;
  int looks_ = 0;
};

}  // namespace deformlab
