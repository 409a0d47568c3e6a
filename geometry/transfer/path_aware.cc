#include "geometry/transfer/path_aware.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <utility>

#include "geometry/core/disjoint_sets.h"
#include "geometry/core/pair_table.h"
#include "geometry/transfer/nearest_nodes.h"
#include "geometry/transfer/surface_roads.h"
#include "geometry/transfer/weld.h"

namespace deformlab {
namespace {

constexpr double kPathShare = 0.8;
constexpr int kStopsPerSource = 10;  // stops on a large mesh
constexpr int kFewestStops = 2000;
// Candidates of each vertex, as a multiple of the sources that are wanted: a source that is among
// the nearest by the rule may come later in the order of paths.
constexpr int kCandidates = 2;
constexpr double kTiny = std::numeric_limits<double>::min();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Matrix3Xi welded_triangles(const Shape& shape, const std::vector<int>& first) {
  Eigen::Matrix3Xi T = triangles(shape);
  for (int& i : T.reshaped()) i = first[i];
  return T;
}

std::vector<int> parts_of(const std::vector<int>& first, const std::vector<Link>& links) {
  DisjointSets sets(static_cast<Eigen::Index>(first.size()));
  for (const Link& link : links) sets.join(link.a, link.b);
  for (std::size_t i = 0; i < first.size(); ++i) sets.join(static_cast<int>(i), first[i]);
  return sets.numbered();
}

// The edges of the triangles, most of them twice. Finding the copies would cost more than they do.
std::vector<Link> triangle_sides(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  std::vector<Link> links;
  links.reserve(static_cast<std::size_t>(T.size()));
  for (const auto t : T.colwise()) {
    for (int c = 0; c < 3; ++c) {
      const int a = t[c], b = t[(c + 1) % 3];
      if (a != b) links.push_back({a, b, (V.col(a) - V.col(b)).norm()});
    }
  }
  return links;
}

// The vertices between which paths are measured, and the roads between them.
struct Stops {
  std::vector<int> vertices;
  std::vector<int> of_vertex;  // the stop that is nearest to each vertex
  Roads roads;
};

// Chooses the sources, and one vertex of each part of the surface in each cell of a grid.
std::vector<int> choose_stops(const Eigen::Matrix3Xd& V, std::span<const int> sources,
                              const std::vector<int>& part, const std::vector<int>& first,
                              double cell) {
  std::vector<int> stops;
  std::vector<char> taken(static_cast<std::size_t>(V.cols()), 0);
  const auto take = [&](int i) {
    if (!std::exchange(taken[i], 1)) stops.push_back(i);
  };
  for (const int s : sources) take(first[s]);
  const Eigen::Vector3d low = V.rowwise().minCoeff();
  std::unordered_map<std::uint64_t, int> cells;
  for (int i = 0; i < V.cols(); ++i) {
    if (first[i] != i) continue;
    std::uint64_t key = static_cast<std::uint64_t>(part[i]) + 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::uint64_t>((V(axis, i) - low[axis]) / cell);
      key = (key ^ at) * 0x9E3779B97F4A7C15;
      key ^= key >> 32;
    }
    if (cells.try_emplace(key, i).second) take(i);
  }
  return stops;
}

struct Way {
  double distance = kInfinity;
  int stop = -1;
  friend auto operator<=>(const Way&, const Way&) = default;
};

// The nearest stop of each vertex. Ways are corrected until none becomes shorter, which takes few
// rounds because a stop has only some hundred vertices around it.
std::vector<Way> ways_to_stops(const Roads& roads, const std::vector<int>& stops) {
  std::vector<Way> ways(static_cast<std::size_t>(roads.vertices()));
  std::vector<char> waits(ways.size(), 0);
  std::deque<int> queue(stops.begin(), stops.end());
  for (std::size_t s = 0; s < stops.size(); ++s) ways[stops[s]] = {0, static_cast<int>(s)};
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop_front();
    waits[at] = 0;
    for (const auto& [to, length] : roads.from(at)) {
      const Way way{ways[at].distance + length, ways[at].stop};
      if (!(way < ways[to])) continue;
      ways[to] = way;
      if (!std::exchange(waits[to], 1)) queue.push_back(to);
    }
  }
  return ways;
}

// Two stops are joined where their vertices are neighbours. The road is straight, because the
// surface between such stops is nearly flat.
Stops coarse_stops(const Eigen::Matrix3Xd& V, const std::vector<Link>& links,
                   std::vector<int> chosen) {
  const std::vector<Way> ways = ways_to_stops(Roads(V.cols(), links), chosen);
  PairTable joined;
  std::vector<Link> between;
  for (const Link& link : links) {
    const int a = ways[link.a].stop, b = ways[link.b].stop;
    if (a == b || joined.enter(a, b, 0) != PairTable::kNone) continue;
    between.push_back({a, b, (V.col(chosen[a]) - V.col(chosen[b])).norm()});
  }
  std::vector<int> of_vertex;
  for (const Way& way : ways) of_vertex.push_back(way.stop);
  const auto count = static_cast<Eigen::Index>(chosen.size());
  return {std::move(chosen), std::move(of_vertex), Roads(count, between)};
}

class PathAware {
 public:
  PathAware(const Shape& shape, std::span<const int> sources, int count)
      : V_(shape.V),
        count_(count),
        first_(weld(V_)),
        g_(V_(Eigen::all, std::vector<int>(sources.begin(), sources.end()))),
        seen_(sources.size(), -1),
        path_(sources.size()),
        nearest_(count, V_.cols()) {
    const Eigen::Matrix3Xi T = welded_triangles(shape, first_);
    const std::vector<Link> sides = triangle_sides(V_, T);
    part_ = parts_of(first_, sides);
    for (const int s : sources) part_of_source_.push_back(part_[first_[s]]);
    measure(make_stops(T, sides, sources), sources);
  }

  NearestSources result() && { return std::move(nearest_); }

 private:
  Stops make_stops(const Eigen::Matrix3Xi& T, const std::vector<Link>& sides,
                   std::span<const int> sources) const {
    const auto wanted = std::max<std::size_t>(kStopsPerSource * sources.size(), kFewestStops);
    if (static_cast<std::size_t>(V_.cols()) <= 2 * wanted) {
      std::vector<int> all(static_cast<std::size_t>(V_.cols()));
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
      return {all, all, Roads(V_.cols(), surface_links(V_, T))};
    }
    double squares = 0;  // a triangle has half the area of a square over its edges
    for (const Link& side : sides) squares += side.length * side.length;
    const double area =
        squares / static_cast<double>(sides.size()) * static_cast<double>(V_.cols());
    const double size = std::sqrt(area / static_cast<double>(wanted));
    const double least = 1e-6 * bounding_box_diagonal(V_);  // numbers of cells stay small
    const double cell = size > least ? size : std::max(least, kTiny);
    return coarse_stops(V_, sides, choose_stops(V_, sources, part_, first_, cell));
  }

  void measure(const Stops& stops, std::span<const int> sources) {
    std::vector<int> at;
    for (const int s : sources) at.push_back(stops.of_vertex[first_[s]]);
    const int candidates = std::min<int>(kCandidates * count_, static_cast<int>(sources.size()));
    const NearestSources paths = nearest_by_roads(stops.roads, at, candidates);
    const bool all_stop = stops.vertices.size() == first_.size();
    NearestNodes in_space(g_, std::min<int>(count_, static_cast<int>(sources.size())));
    const bool many_parts = std::ranges::max(part_) > 0;
    for (int i = 0; i < V_.cols(); ++i) {
      if (first_[i] != i) {
        copy(first_[i], i);
        continue;
      }
      const int own = stops.of_vertex[i];
      add_paths(paths, stops, own, i);
      if (!all_stop) {
        for (const auto& road : stops.roads.from(own)) add_paths(paths, stops, road.to, i);
      }
      enter(i);
      if (many_parts) add_straight(in_space, i);
    }
  }

  // Paths from vertex i by way of a stop.
  void add_paths(const NearestSources& paths, const Stops& stops, int stop, int i) {
    const double to_stop = (V_.col(i) - V_.col(stops.vertices[stop])).norm();
    for (int a = 0; a < paths.found[stop]; ++a) {
      const int s = paths.sources(a, stop);
      const double path = to_stop + paths.distances(a, stop);
      if (seen_[s] != i) {
        seen_[s] = i;
        path_[s] = path;
        reached_.push_back(s);
      } else {
        path_[s] = std::min(path_[s], path);
      }
    }
  }

  void enter(int i) {
    for (const int s : reached_) {
      nearest_.insert(i, s, std::max((V_.col(i) - g_.col(s)).norm(), kPathShare * path_[s]));
    }
    reached_.clear();
  }

  void add_straight(NearestNodes& in_space, int i) {
    const int count = std::min<int>(count_, static_cast<int>(g_.cols()));
    std::vector<int> nodes(count);
    std::vector<double> distances(count);
    in_space.find(V_.col(i), nodes.data(), distances.data());
    for (int a = 0; a < count; ++a) {
      if (part_of_source_[nodes[a]] != part_[i]) nearest_.insert(i, nodes[a], distances[a]);
    }
  }

  void copy(int from, int to) {
    nearest_.sources.col(to) = nearest_.sources.col(from);
    nearest_.distances.col(to) = nearest_.distances.col(from);
    nearest_.found[to] = nearest_.found[from];
  }

  const Eigen::Matrix3Xd& V_;
  const int count_;
  const std::vector<int> first_;
  const Eigen::Matrix3Xd g_;  // the sources
  std::vector<int> part_, part_of_source_;
  std::vector<int> seen_;     // by source: the vertex for which path_ holds
  std::vector<double> path_;  // by source
  std::vector<int> reached_;  // the sources with a path
  NearestSources nearest_;
};

}  // namespace

NearestSources nearest_path_aware(const Shape& shape, std::span<const int> sources, int count) {
  return PathAware(shape, sources, count).result();
}

}  // namespace deformlab
