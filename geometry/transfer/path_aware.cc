#include "geometry/transfer/path_aware.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "geometry/transfer/nearest_nodes.h"
#include "geometry/transfer/path_stops.h"

namespace deformlab {
namespace {

constexpr double kPathShare = 0.8;
// Candidates of each vertex, as a multiple of the sources that are wanted: a source that is among
// the nearest by the rule may come later in the order of paths.
constexpr int kCandidates = 2;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A stop and its neighbours, and the paths from them to the sources that are nearest to them. The
// vertices around the stop share these.
class AroundStop {
 public:
  AroundStop(const PathStops& stops, const NearestSources& paths, std::size_t sources)
      : stops_(stops), paths_(paths), place_(sources, -1) {}

  void look_at(int stop, bool with_neighbors) {
    near_.assign(1, stop);
    if (with_neighbors) {
      for (const auto& road : stops_.roads.from(stop)) near_.push_back(road.to);
    }
    for (const int s : sources_) place_[s] = -1;
    sources_.clear();
    distances_.clear();
    for (std::size_t n = 0; n < near_.size(); ++n) add_paths(n);
  }

  /// The sources, in the order in which they are found.
  const std::vector<int>& sources() const { return sources_; }

  void begin_at(const Eigen::Matrix3Xd& V, int vertex) {
    to_stop_.clear();
    for (const int stop : near_) {
      to_stop_.push_back((V.col(vertex) - V.col(stops_.vertices[stop])).norm());
    }
  }
  /// The length of the shortest path to a source, from the vertex of begin_at.
  double path(std::size_t source) const {
    const double* distance = distances_.data() + source * near_.size();
    double least = kInfinity;
    for (const double to_stop : to_stop_) least = std::min(least, to_stop + *distance++);
    return least;
  }

 private:
  void add_paths(std::size_t n) {
    const int stop = near_[n];
    for (int a = 0; a < paths_.found[stop]; ++a) {
      int& place = place_[paths_.sources(a, stop)];
      if (place < 0) {
        place = static_cast<int>(sources_.size());
        sources_.push_back(paths_.sources(a, stop));
        distances_.resize(distances_.size() + near_.size(), kInfinity);
      }
      distances_[place * near_.size() + n] = paths_.distances(a, stop);
    }
  }

  const PathStops& stops_;
  const NearestSources& paths_;
  std::vector<int> near_, sources_;
  std::vector<int> place_;         // of each source among sources_, or −1
  std::vector<double> distances_;  // #near_×#sources_
  std::vector<double> to_stop_;
};

class PathAware {
 public:
  PathAware(const WeldedSurface& surface, std::span<const int> sources, int count)
      : V_(surface.shape().V),
        first_(surface.first()),
        g_(V_(Eigen::all, std::vector<int>(sources.begin(), sources.end()))),
        nearest_(count, V_.cols()) {
    const Eigen::Matrix3Xi T = surface.welded_triangles();
    const std::vector<int> part = surface.parts(T);
    measure(choose_path_stops(surface, T, part, sources), sources);
    if (std::ranges::max(part) > 0) add_straight(part, sources);
    for (int i = 0; i < V_.cols(); ++i) {
      if (first_[i] != i) copy(first_[i], i);
    }
  }

  NearestSources result() && { return std::move(nearest_); }

 private:
  int most() const {
    return static_cast<int>(std::min<Eigen::Index>(nearest_.sources.rows(), g_.cols()));
  }

  void measure(const PathStops& stops, std::span<const int> sources) {
    std::vector<int> at;
    for (const int s : sources) at.push_back(stops.of_vertex[first_[s]]);
    const int candidates =
        static_cast<int>(std::min<Eigen::Index>(kCandidates * nearest_.sources.rows(), g_.cols()));
    const NearestSources paths = nearest_by_roads(stops.roads, at, candidates);
    const bool all_stop = stops.vertices.size() == first_.size();
    AroundStop around(stops, paths, sources.size());
    const std::vector<int> order = by_stop(stops);
    int stop = -1;
    for (const int i : order) {
      if (stops.of_vertex[i] != stop) around.look_at(stop = stops.of_vertex[i], !all_stop);
      enter(around, i);
    }
  }

  // The first vertices of all places, in the order of their stops.
  std::vector<int> by_stop(const PathStops& stops) const {
    std::vector<int> next(stops.vertices.size() + 1, 0);
    const auto each = [&](const auto& visit) {
      for (int i = 0; i < V_.cols(); ++i) {
        if (first_[i] == i) visit(i, stops.of_vertex[i]);
      }
    };
    each([&](int, int stop) { ++next[stop + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<int> order(static_cast<std::size_t>(next.back()));
    each([&](int i, int stop) { order[next[stop]++] = i; });
    return order;
  }

  void enter(AroundStop& around, int i) {
    around.begin_at(V_, i);
    const auto worst = nearest_.distances.bottomRows<1>();
    for (std::size_t s = 0; s < around.sources().size(); ++s) {
      const int source = around.sources()[s];
      const double straight = (V_.col(i) - g_.col(source)).norm();
      if (straight >= worst[i]) continue;  // and so is the greater of it and the path
      nearest_.insert(i, source, std::max(straight, kPathShare * around.path(s)));
    }
  }

  // Between parts that no path joins, the straight distance counts.
  void add_straight(const std::vector<int>& part, std::span<const int> sources) {
    const int count = most();
    NearestNodes in_space(g_, count);
    std::vector<int> nodes(count);
    std::vector<double> distances(count);
    for (int i = 0; i < V_.cols(); ++i) {
      if (first_[i] != i) continue;
      in_space.find(V_.col(i), nodes.data(), distances.data());
      for (int a = 0; a < count; ++a) {
        if (part[sources[nodes[a]]] != part[i]) nearest_.insert(i, nodes[a], distances[a]);
      }
    }
  }

  void copy(int from, int to) {
    nearest_.sources.col(to) = nearest_.sources.col(from);
    nearest_.distances.col(to) = nearest_.distances.col(from);
    nearest_.found[to] = nearest_.found[from];
  }

  const Eigen::Matrix3Xd& V_;
  const std::vector<int>& first_;
  const Eigen::Matrix3Xd g_;  // the sources
  NearestSources nearest_;
};

}  // namespace

NearestSources nearest_path_aware(const WeldedSurface& surface, std::span<const int> sources,
                                  int count) {
  return PathAware(surface, sources, count).result();
}

}  // namespace deformlab
