#include "deformers/baselines/manifold.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "deformers/baselines/shared.h"

namespace deformlab {
namespace {

// A side of a triangle, from its k-th corner to the next.
struct Side {
  int low, high;  // vertices
  int triangle, k;
  bool upward;  // from the lower vertex to the higher
};

std::vector<Side> sorted_sides(const Eigen::Matrix3Xi& T) {
  std::vector<Side> sides;
  for (int t = 0; t < T.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = T(k, t), to = T((k + 1) % 3, t);
      sides.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

std::string name(const Side& side) {
  return "the edge between vertices " + std::to_string(side.low) + " and " +
         std::to_string(side.high);
}

// Of the corners (3 t + k) of all triangles those that an edge joins.
std::vector<std::pair<int, int>> joined_corners(const Side& a, const Side& b) {
  const auto corner = [](const Side& s, bool low) {
    return 3 * s.triangle + (low == s.upward ? s.k : (s.k + 1) % 3);
  };
  return {{corner(a, true), corner(b, true)}, {corner(a, false), corner(b, false)}};
}

// A vertex whose corners are not all joined over edges, or −1.
int vertex_of_two_fans(const Eigen::Matrix3Xi& T, int n,
                       const std::vector<std::pair<int, int>>& links) {
  const std::vector<int> fan = baselines::components(static_cast<int>(T.size()), links);
  std::vector<int> fan_of(n, -1);
  for (int c = 0; c < T.size(); ++c) {
    int& first = fan_of[T(c % 3, c / 3)];
    if (first < 0) first = fan[c];
    if (first != fan[c]) return T(c % 3, c / 3);
  }
  return -1;
}

}  // namespace

std::string manifold_fault(const Eigen::Matrix3Xi& T, int n) {
  const std::vector<Side> sides = sorted_sides(T);
  const auto same_edge = [](const Side& a, const Side& b) {
    return a.low == b.low && a.high == b.high;
  };
  std::vector<std::pair<int, int>> links;
  for (std::size_t s = 0; s + 1 < sides.size(); ++s) {
    const Side &a = sides[s], &b = sides[s + 1];
    if (!same_edge(a, b)) continue;
    if (s + 2 < sides.size() && same_edge(a, sides[s + 2])) {
      return name(a) + " has more than two triangles";
    }
    if (a.upward == b.upward) return name(a) + " has two triangles that face opposite ways";
    for (const auto& link : joined_corners(a, b)) links.push_back(link);
  }
  const int v = vertex_of_two_fans(T, n, links);
  if (v < 0) return "";
  return "vertex " + std::to_string(v) + " is a point where parts of the surface only touch";
}

}  // namespace deformlab
