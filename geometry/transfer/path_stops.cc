#include "geometry/transfer/path_stops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "geometry/core/hash.h"
#include "geometry/core/pair_table.h"

namespace deformlab {
namespace {

constexpr int kStopsPerSource = 10;  // on a large mesh
constexpr int kFewestStops = 2000;
constexpr double kTiny = std::numeric_limits<double>::min();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Calls visit(a, b) for the sides of the triangles, most of which two triangles share. Finding the
// copies would cost more than they do.
template <class Visit>
void each_side(const Eigen::Matrix3Xi& T, const Visit& visit) {
  for (const auto t : T.colwise()) {
    for (int c = 0; c < 3; ++c) {
      if (t[c] != t[(c + 1) % 3]) visit(t[c], t[(c + 1) % 3]);
    }
  }
}

// The size of a cell that holds one of the wanted stops.
double cell_size(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T, std::size_t wanted) {
  double squares = 0;  // a triangle has half the area of a square over its edges
  std::size_t sides = 0;
  each_side(T, [&](int a, int b) {
    const double length = (V.col(a) - V.col(b)).norm();
    squares += length * length;
    ++sides;
  });
  const double area = squares / static_cast<double>(sides) * static_cast<double>(V.cols());
  const double size = std::sqrt(area / static_cast<double>(wanted));
  const double least = 1e-6 * bounding_box_diagonal(V);  // numbers of cells stay small
  return size > least ? size : std::max(least, kTiny);
}

// A cell of a grid, and a part of the surface in it.
using PartInCell = std::array<std::int64_t, 4>;

struct HashOfPart {
  std::size_t operator()(const PartInCell& key) const {
    std::uint64_t hash = 0;
    for (const std::int64_t x : key) hash = mixed(hash, static_cast<std::uint64_t>(x));
    return hash;
  }
};

// Chooses the sources, and one vertex of each part of the surface in each cell of a grid.
std::vector<int> choose_vertices(const WeldedSurface& surface, std::span<const int> part,
                                 std::span<const int> sources, double cell) {
  const Eigen::Matrix3Xd& V = surface.shape().V;
  const std::vector<int>& first = surface.first();
  std::vector<int> stops;
  std::vector<char> taken(static_cast<std::size_t>(V.cols()), 0);
  const auto take = [&](int i) {
    if (!std::exchange(taken[i], 1)) stops.push_back(i);
  };
  for (const int s : sources) take(first[s]);
  const Eigen::Vector3d low = V.rowwise().minCoeff();
  std::unordered_set<PartInCell, HashOfPart> cells;
  for (int i = 0; i < V.cols(); ++i) {
    if (first[i] != i) continue;
    PartInCell key{part[i]};
    for (int axis = 0; axis < 3; ++axis) {
      key[axis + 1] = static_cast<std::int64_t>((V(axis, i) - low[axis]) / cell);
    }
    if (cells.insert(key).second) take(i);  // a part without a stop would have no paths
  }
  return stops;
}

// The vertices that a side joins to each vertex. A vertex may occur twice.
class Neighbors {
 public:
  Neighbors(Eigen::Index vertices, const Eigen::Matrix3Xi& T)
      : first_(static_cast<std::size_t>(vertices) + 1, 0) {
    each_side(T, [&](int a, int b) { ++first_[a + 1], ++first_[b + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    neighbors_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    each_side(T, [&](int a, int b) { neighbors_[next[a]++] = b, neighbors_[next[b]++] = a; });
  }
  std::span<const int> of(int vertex) const {
    return std::span(neighbors_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<int> neighbors_;
};

struct Way {
  double distance = kInfinity;
  int stop = -1;
  friend auto operator<=>(const Way&, const Way&) = default;
};

// The nearest stop of each vertex. Ways are corrected until none becomes shorter, which takes few
// rounds because a stop has only some hundred vertices around it.
std::vector<int> nearest_stops(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T,
                               const std::vector<int>& stops) {
  const Neighbors neighbors(V.cols(), T);
  std::vector<Way> ways(static_cast<std::size_t>(V.cols()));
  std::vector<char> waits(ways.size(), 0);
  std::deque<int> queue(stops.begin(), stops.end());
  for (std::size_t s = 0; s < stops.size(); ++s) ways[stops[s]] = {0, static_cast<int>(s)};
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop_front();
    waits[at] = 0;
    for (const int to : neighbors.of(at)) {
      if (!(ways[at].distance < ways[to].distance)) continue;
      const Way way{ways[at].distance + (V.col(at) - V.col(to)).norm(), ways[at].stop};
      if (!(way < ways[to])) continue;
      ways[to] = way;
      if (!std::exchange(waits[to], 1)) queue.push_back(to);
    }
  }
  std::vector<int> nearest;
  nearest.reserve(ways.size());
  for (const Way& way : ways) nearest.push_back(way.stop);
  return nearest;
}

// Two stops are joined where their vertices are neighbours. The road is straight, because the
// surface between such stops is nearly flat.
Roads roads_between(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T,
                    const std::vector<int>& vertices, const std::vector<int>& of_vertex) {
  PairTable joined;
  std::vector<Link> between;
  each_side(T, [&](int one, int other) {
    const int a = of_vertex[one], b = of_vertex[other];
    if (a == b || joined.enter(a, b, 0) != PairTable::kNone) return;
    between.push_back({a, b, (V.col(vertices[a]) - V.col(vertices[b])).norm()});
  });
  return {static_cast<Eigen::Index>(vertices.size()), between};
}

}  // namespace

PathStops choose_path_stops(const WeldedSurface& surface, const Eigen::Matrix3Xi& T,
                            std::span<const int> part, std::span<const int> sources) {
  const Eigen::Matrix3Xd& V = surface.shape().V;
  const auto wanted = std::max<std::size_t>(kStopsPerSource * sources.size(), kFewestStops);
  if (static_cast<std::size_t>(V.cols()) <= 2 * wanted) {
    std::vector<int> all(static_cast<std::size_t>(V.cols()));
    std::iota(all.begin(), all.end(), 0);
    return {all, all, Roads(V.cols(), surface_links(V, T))};
  }
  std::vector<int> vertices = choose_vertices(surface, part, sources, cell_size(V, T, wanted));
  std::vector<int> of_vertex = nearest_stops(V, T, vertices);
  Roads roads = roads_between(V, T, vertices, of_vertex);
  return {std::move(vertices), std::move(of_vertex), std::move(roads)};
}

}  // namespace deformlab
