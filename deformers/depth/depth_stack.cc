#include "deformers/depth/depth_stack.h"

#include <algorithm>
#include <utility>

namespace deformlab {
namespace {

constexpr int kNone = -1;
constexpr int kMostLooks = 1 << 22;

}  // namespace

DepthStack::DepthStack(std::vector<int> back_to_front)
    : back_to_front_(std::move(back_to_front)),
      place_(back_to_front_.size()),
      first_front_(back_to_front_.size(), kNone),
      first_back_(back_to_front_.size(), kNone),
      visited_(back_to_front_.size(), 0) {
  for (std::size_t i = 0; i < back_to_front_.size(); ++i) {
    place_[back_to_front_[i]] = static_cast<int>(i);
  }
}

bool DepthStack::put(int back, int front) {
  if (place_[back] >= place_[front]) {
    if (back == front || looks_ > kMostLooks) return false;
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
  ++looks_;
  if (visited_[item]) return false;
  visited_[item] = 1;
  found.push_back(item);
  return true;
}

// All that has to be in front of `from` and is not in front of `until`; false if that holds
// `until`.
bool DepthStack::gather_in_front(int from, int until) {
  visit(from, in_front_);
  for (std::size_t i = 0; i < in_front_.size(); ++i) {
    for (int l = first_front_[in_front_[i]]; l != kNone; l = links_[l].next_front) {
      const int item = links_[l].front;
      if (item == until) return false;
      if (place_[item] < place_[until]) visit(item, in_front_);
    }
  }
  return true;
}

// All that has to be behind `from` and is not behind `until`.
void DepthStack::gather_behind(int from, int until) {
  visit(from, behind_);
  for (std::size_t i = 0; i < behind_.size(); ++i) {
    for (int l = first_back_[behind_[i]]; l != kNone; l = links_[l].next_back) {
      const int item = links_[l].back;
      if (place_[item] > place_[until]) visit(item, behind_);
    }
  }
}

// Both kinds share their places anew: first what is behind, each kind in the order it had.
void DepthStack::reorder() {
  const auto place = [&](int item) { return place_[item]; };
  std::ranges::sort(behind_, {}, place);
  std::ranges::sort(in_front_, {}, place);
  std::vector<int> items = behind_, places;
  items.insert(items.end(), in_front_.begin(), in_front_.end());
  for (const int item : items) places.push_back(place_[item]);
  std::ranges::sort(places);
  for (std::size_t i = 0; i < items.size(); ++i) {
    place_[items[i]] = places[i];
    back_to_front_[places[i]] = items[i];
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
  looks_ = 0;
}

std::vector<int> DepthStack::heights() const {
  std::vector<int> height(place_.size(), 0);
  for (const int item : back_to_front_) {
    for (int l = first_front_[item]; l != kNone; l = links_[l].next_front) {
      height[links_[l].front] = std::max(height[links_[l].front], height[item] + 1);
    }
  }
  return height;
}

}  // namespace deformlab
