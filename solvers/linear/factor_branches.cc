#include "solvers/linear/factor_branches.h"

#include <algorithm>
#include <numeric>

namespace deformlab {
namespace {

constexpr std::size_t kBranches = 4;
constexpr std::size_t kLeastWork = 200000;  // entries; less takes no longer than sharing it out
constexpr std::size_t kShare = 8;           // no subtree is more than this part of the whole

using Range = FactorBranches::Range;

// Splits the largest subtree into those below its root until all are small. A subtree is a range
// that ends with its root.
std::vector<int> small_subtrees(const std::vector<int>& parent,
                                const std::vector<std::size_t>& below, std::size_t most) {
  const auto smaller = [&](int a, int b) {
    return below[a] < below[b] || (below[a] == below[b] && a < b);
  };
  std::vector<std::vector<int>> children(parent.size());
  std::vector<int> roots, done;
  for (int i = 0; i < static_cast<int>(parent.size()); ++i) {
    (parent[i] < 0 ? roots : children[parent[i]]).push_back(i);
  }
  std::ranges::make_heap(roots, smaller);
  while (!roots.empty() && below[roots.front()] > most) {
    const int root = roots.front();
    std::ranges::pop_heap(roots, smaller);
    roots.pop_back();
    for (const int child : children[root]) {
      roots.push_back(child);
      std::ranges::push_heap(roots, smaller);
    }
  }
  std::ranges::sort(roots, [&](int a, int b) { return smaller(b, a); });
  return roots;
}

// Neighbouring ranges become one.
std::vector<Range> joined(std::vector<Range> ranges) {
  std::ranges::sort(ranges, {}, &Range::begin);
  std::vector<Range> result;
  for (const Range& range : ranges) {
    if (!result.empty() && result.back().end == range.begin) {
      result.back().end = range.end;
    } else {
      result.push_back(range);
    }
  }
  return result;
}

}  // namespace

FactorBranches find_branches(const std::vector<int>& parent, const std::vector<std::size_t>& work) {
  const auto n = static_cast<int>(parent.size());
  FactorBranches result;
  const std::size_t all = std::accumulate(work.begin(), work.end(), std::size_t{0});
  if (all < kLeastWork) {
    if (n > 0) result.top.push_back({0, n});
    return result;
  }
  std::vector<std::size_t> below = work;  // of a node's subtree
  std::vector<int> first(n);              // node of each subtree
  std::iota(first.begin(), first.end(), 0);
  for (int i = 0; i < n; ++i) {
    if (parent[i] < 0) continue;
    below[parent[i]] += below[i];
    first[parent[i]] = std::min(first[parent[i]], first[i]);
  }
  result.branches.resize(kBranches);
  std::vector<std::size_t> load(kBranches, 0);
  std::vector<char> taken(n, 0);
  for (const int root : small_subtrees(parent, below, all / kShare)) {  // the largest first
    const auto least = std::ranges::min_element(load) - load.begin();
    load[least] += below[root];
    result.branches[least].push_back({first[root], root + 1});
    std::fill(taken.begin() + first[root], taken.begin() + root + 1, 1);
  }
  for (auto& branch : result.branches) branch = joined(std::move(branch));
  for (int i = 0; i < n; ++i) {
    if (!taken[i]) result.top.push_back({i, i + 1});
  }
  result.top = joined(std::move(result.top));
  return result;
}

}  // namespace deformlab
