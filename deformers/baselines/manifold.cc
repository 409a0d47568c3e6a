#include "deformers/baselines/manifold.h"

#include <fmt/format.h>

#include <vector>

#include "deformers/baselines/sides.h"
#include "geometry/core/disjoint_sets.h"

namespace deformlab {
namespace {

std::string name(const Side& side) {
  return fmt::format("the edge between vertices {} and {}", side.low, side.high);
}

// The corner of a side at its lower or higher vertex, as the index 3 t + k among all corners.
int corner(const Side& side, bool low) {
  return 3 * side.triangle + (low == side.upward ? side.k : (side.k + 1) % 3);
}

// A vertex with more than one fan, or −1 where there is none. A set of `fans` contains the corners
// at a vertex that are connected across edges.
int vertex_of_two_fans(const Eigen::Matrix3Xi& T, int n, DisjointSets fans) {
  std::vector<int> fan_of(n, -1);
  for (int c = 0; c < T.size(); ++c) {
    int& first = fan_of[T(c % 3, c / 3)];
    if (first < 0) first = fans.root(c);
    if (first != fans.root(c)) return T(c % 3, c / 3);
  }
  return -1;
}

}  // namespace

std::string manifold_fault(const Eigen::Matrix3Xi& T, int n) {
  const std::vector<Side> sides = sorted_sides(T);
  DisjointSets fans(T.size());
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    const Side &a = sides[s], &b = sides[s + 1];
    if (!a.same_edge(b)) continue;
    if (s + 2 < sides.size() && a.same_edge(sides[s + 2])) {
      return name(a) + " has more than two triangles";
    }
    if (a.upward == b.upward) return name(a) + " has two triangles that face opposite ways";
    for (const bool low : {true, false}) fans.join(corner(a, low), corner(b, low));
  }
  const int v = vertex_of_two_fans(T, n, fans);
  if (v < 0) return "";
  return fmt::format("vertex {} is a point where parts of the surface only touch", v);
}

}  // namespace deformlab
