#include "deformers/depth/depth_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/core/error.h"
#include "geometry/transfer/geodesic.h"

namespace deformlab {
namespace {

using Distances = Eigen::VectorXd;

// The distance along the edges of each vertex from the source in its connected part.
Distances distances(const Shape& shape, const std::vector<int>& sources) {
  return nearest_along_edges(shape, sources, 1).distances.row(0).transpose();
}

// For each part the first vertex at which `value` is greatest.
std::vector<int> greatest(const std::vector<int>& part, const Eigen::VectorXd& value) {
  std::vector<int> result;
  for (int v = 0; v < static_cast<int>(part.size()); ++v) {
    if (part[v] == static_cast<int>(result.size())) result.push_back(v);
    int& best = result[part[v]];
    if (value[v] > value[best]) best = v;
  }
  return result;
}

// The mean of the order (#V) over the corners of each triangle, #F.
Eigen::VectorXd over_triangles(const Triangulation& rest, const Eigen::VectorXd& order) {
  if (order.size() != rest.V.cols() || !order.allFinite()) {
    throw InputError(fmt::format(
        "the order has {} entries for {} vertices; it needs one finite number for each, "
        "higher ones nearer to the viewer",
        order.size(), rest.V.cols()));
  }
  Eigen::VectorXd result(rest.F.cols());
  for (Eigen::Index t = 0; t < rest.F.cols(); ++t) result[t] = order(rest.F.col(t)).mean();
  return result;
}

std::vector<int> sorted_by(const Eigen::VectorXd& order) {
  std::vector<int> result(order.size());
  std::iota(result.begin(), result.end(), 0);
  std::ranges::stable_sort(result, {}, [&](int t) { return order[t]; });
  return result;
}

}  // namespace

Eigen::VectorXd distance_from_middle(const Triangulation& rest) {
  const Shape shape = to_shape(rest);
  const std::vector<int> part = connected_parts(shape);
  const auto first = greatest(part, Eigen::VectorXd::Zero(rest.V.cols()));
  const auto one_end = greatest(part, distances(shape, first));
  const Distances from_one_end = distances(shape, one_end);
  const Distances from_other_end = distances(shape, greatest(part, from_one_end));
  const auto middle = greatest(part, -from_one_end.cwiseMax(from_other_end));
  Eigen::VectorXd order = distances(shape, middle);
  double before = 0;  // the sum of the depths of earlier parts
  std::vector<double> offset;
  for (const int end : greatest(part, order)) {
    offset.push_back(before);
    before += order[end];
  }
  for (Eigen::Index v = 0; v < order.size(); ++v) order[v] += offset[part[v]];
  return order;
}

DepthOrder::DepthOrder(const Triangulation& rest, const Eigen::VectorXd& order)
    : find_(rest),
      order_(over_triangles(rest, order)),
      by_order_(sorted_by(order_)),
      stack_(by_order_),
      depth_(Eigen::VectorXd::Zero(rest.F.cols())) {}

void DepthOrder::reset() {
  memory_.forget();
  stack_ = DepthStack(by_order_);
}

const Eigen::VectorXd& DepthOrder::update(const Eigen::Matrix2Xd& V) {
  overlaps_ = find_(V);
  report_ = {.regions = static_cast<int>(overlaps_.regions.size()), .found = overlaps_.complete};
  stack_.clear();
  const std::vector<Choice> all = choices();
  for (const Choice& choice : all) {
    if (choice.mixed) put_remembered(overlaps_.regions[choice.region]);
  }
  for (const Choice& choice : all) enter(choice);
  remember();
  if (overlaps_.complete) {
    spread(stack_.heights());
  } else {
    for (std::size_t i = 0; i < by_order_.size(); ++i) depth_[by_order_[i]] = i;
  }
  return depth_;
}

// The choice of each region if it were alone. Lasting regions come first, large before small ones.
std::vector<DepthOrder::Choice> DepthOrder::choices() const {
  const auto recalled = memory_.recall(overlaps_);
  std::vector<Choice> result;
  for (int r = 0; r < report_.regions; ++r) {
    double vote = recalled[r].vote;
    const bool lasting = vote != 0;
    if (!lasting) {
      for (const TrianglePair& pair : overlaps_.pairs_of(overlaps_.regions[r])) {
        vote += pair.area * (order_[pair.a] - order_[pair.b]);
      }
    }
    result.push_back({r, vote > 0, lasting, recalled[r].mixed});
  }
  std::ranges::stable_sort(result, {}, [&](const Choice& c) {
    return std::tuple(!c.lasting, -overlaps_.regions[c.region].area);
  });
  return result;
}

void DepthOrder::enter(const Choice& choice) {
  const OverlapRegion& region = overlaps_.regions[choice.region];
  report_.twisted += region.twisted;
  if (choice.mixed) {
    put_by_neighbours(region, choice.a_in_front);
    ++report_.cyclic;
  } else if (put_all(region, choice.a_in_front)) {
    report_.lasting += choice.lasting;
  } else if (put_all(region, !choice.a_in_front)) {
    report_.turned += choice.lasting;
  } else {
    put_each(region, choice.a_in_front);
    ++report_.cyclic;
  }
}

bool DepthOrder::put(const TrianglePair& pair, bool a_in_front) {
  return a_in_front ? stack_.put(pair.b, pair.a) : stack_.put(pair.a, pair.b);
}

bool DepthOrder::put_all(const OverlapRegion& region, bool a_in_front) {
  const std::size_t before = stack_.constraints();
  for (const TrianglePair& pair : overlaps_.pairs_of(region)) {
    if (put(pair, a_in_front)) continue;
    stack_.take_back_to(before);
    return false;
  }
  return true;
}

// A pair that would close a cycle is put the other way, which the stack already implies.
void DepthOrder::put_each(const OverlapRegion& region, bool a_in_front) {
  for (const TrianglePair& pair : overlaps_.pairs_of(region)) {
    if (!put(pair, a_in_front)) put(pair, !a_in_front);
  }
}

// The order of the last update has no cycle, so that all remembered pairs fit together.
void DepthOrder::put_remembered(const OverlapRegion& region) {
  for (const TrianglePair& pair : overlaps_.pairs_of(region)) {
    const int side = memory_.side(pair.a, pair.b);
    if (side != 0) put(pair, side > 0);
  }
}

void DepthOrder::put_by_neighbours(const OverlapRegion& region, bool a_in_front) {
  const std::vector<int> sides = sides_by_neighbours(region);
  std::size_t i = 0;
  for (const TrianglePair& pair : overlaps_.pairs_of(region)) {
    const bool front = sides[i] == 0 ? a_in_front : sides[i] > 0;
    if (!put(pair, front)) put(pair, !front);
    ++i;
  }
}

// For each pair +1 if its first triangle is to be in front, else −1. Remembered pairs keep their
// order, and all others take that of the nearest one, ring by ring; 0 where there is none.
std::vector<int> DepthOrder::sides_by_neighbours(const OverlapRegion& region) const {
  const auto pairs = overlaps_.pairs_of(region);
  std::vector<int> sides(pairs.size(), 0), ring;
  PairTable index;
  for (int i = 0; i < std::ssize(pairs); ++i) {
    index.enter(pairs[i].a, pairs[i].b, i);
    sides[i] = memory_.side(pairs[i].a, pairs[i].b);
    if (sides[i] != 0) ring.push_back(i);
  }
  const auto reach = [&](int a, int b, int side) {
    const int i = index.find(a, b);
    if (i == PairTable::kNone || sides[i] != 0) return;
    sides[i] = pairs[i].a == a ? side : -side;
    ring.push_back(i);
  };
  for (std::size_t next = 0; next < ring.size(); ++next) {
    const auto& [a, b, area] = pairs[ring[next]];
    const int side = sides[ring[next]];
    for (const int n : find_.neighbours().col(a)) {
      if (n >= 0) reach(n, b, side);
    }
    for (const int n : find_.neighbours().col(b)) {
      if (n >= 0) reach(a, n, side);
    }
  }
  return sides;
}

void DepthOrder::remember() {
  std::vector<bool> a_in_front;
  for (const TrianglePair& pair : overlaps_.pairs) {
    a_in_front.push_back(stack_.in_front(pair.a, pair.b));
  }
  memory_.keep(overlaps_, a_in_front);
}

// Triangles that overlap none take the greatest height of their neighbours, ring by ring.
void DepthOrder::spread(const std::vector<int>& heights) {
  constexpr int kFree = -1;
  std::vector<int> height(heights.size(), kFree), ring, next;
  for (const TrianglePair& pair : overlaps_.pairs) {
    for (const int t : {pair.a, pair.b}) {
      if (height[t] == kFree) ring.push_back(t);
      height[t] = heights[t];
    }
  }
  while (!ring.empty()) {
    std::ranges::stable_sort(ring, std::greater<>(), [&](int t) { return height[t]; });
    next.clear();
    for (const int t : ring) {
      for (const int n : find_.neighbours().col(t)) {
        if (n < 0 || height[n] != kFree) continue;
        height[n] = height[t];
        next.push_back(n);
      }
    }
    ring.swap(next);
  }
  for (std::size_t t = 0; t < height.size(); ++t) depth_[t] = std::max(0, height[t]);
}

}  // namespace deformlab
