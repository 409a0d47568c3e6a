#include "deformers/depth/depth_stack.h"

#include <algorithm>
#include <utility>

namespace deformlab {
namespace {

constexpr int kNone = -1;
constexpr int kMostVisits = 1 << 22;

}  // namespace

DepthStack::DepthStack(std::vector<int> back_to_front)
    : back_to_front_(std::move(back_to_front)),
      rank_(back_to_front_.size()),
      first_front_(back_to_front_.size(), kNone),
      first_back_(back_to_front_.size(), kNone),
      visited_(back_to_front_.size(), 0) {
  for (std::size_t i = 0; i < back_to_front_.size(); ++i) {
    rank_[back_to_front_[i]] = static_cast<int>(i);
  }
}

bool DepthStack::put(int back, int front) {
  if (rank_[back] >= rank_[front]) {
    if (back == front || visits_ > kMostVisits) return false;
    in_front_.clear();
    behind_.clear();
    const bool circle = !gather_in_front(front, back);
    if (!circle) gather_behind(back, front);
    for (const int item : in_front_) visited_[item] = 0;
    for (const int item : behind_) visited_[item] = 0;
    if (circle) return false;
    reorder();
  }
  const int link = static_cast<int>(links_.size());
  links_.push_back({back, front, std::exchange(first_front_[back], link),
                    std::exchange(first_back_[front], link)});
  return true;
}

bool DepthStack::visit(int item, std::vector<int>& found) {
  ++visits_;
  if (visited_[item]) return false;
  visited_[item] = 1;
  found.push_back(item);
  return true;
}

// Gathers all items that have to be in front of `from` and are not in front of `until`. Returns
// false if `until` is one of them.
bool DepthStack::gather_in_front(int from, int until) {
  visit(from, in_front_);
  for (std::size_t i = 0; i < in_front_.size(); ++i) {
    for (int l = first_front_[in_front_[i]]; l != kNone; l = links_[l].next_front) {
      const int item = links_[l].front;
      if (item == until) return false;
      if (rank_[item] < rank_[until]) visit(item, in_front_);
    }
  }
  return true;
}

// Gathers all items that have to be behind `from` and are not behind `until`.
void DepthStack::gather_behind(int from, int until) {
  visit(from, behind_);
  for (std::size_t i = 0; i < behind_.size(); ++i) {
    for (int l = first_back_[behind_[i]]; l != kNone; l = links_[l].next_back) {
      const int item = links_[l].back;
      if (rank_[item] > rank_[until]) visit(item, behind_);
    }
  }
}

// Gives the gathered items new ranks among those that they have together: first the items behind,
// then the items in front, each kind in the order that it had.
void DepthStack::reorder() {
  const auto rank = [&](int item) { return rank_[item]; };
  std::ranges::sort(behind_, {}, rank);
  std::ranges::sort(in_front_, {}, rank);
  std::vector<int> items = behind_, ranks;
  items.insert(items.end(), in_front_.begin(), in_front_.end());
  for (const int item : items) ranks.push_back(rank_[item]);
  std::ranges::sort(ranks);
  for (std::size_t i = 0; i < items.size(); ++i) {
    rank_[items[i]] = ranks[i];
    back_to_front_[ranks[i]] = items[i];
  }
}

void DepthStack::take_back_to(std::size_t constraints) {
  for (; links_.size() > constraints; links_.pop_back()) {
    first_front_[links_.back().back] = links_.back().next_front;
    first_back_[links_.back().front] = links_.back().next_back;
  }
}

void DepthStack::clear() {
  take_back_to(0);
  visits_ = 0;
}

std::vector<int> DepthStack::heights() const {
  std::vector<int> height(rank_.size(), 0);
  for (const int item : back_to_front_) {
    for (int l = first_front_[item]; l != kNone; l = links_[l].next_front) {
      height[links_[l].front] = std::max(height[links_[l].front], height[item] + 1);
    }
  }
  return height;
}

}  // namespace deformlab
