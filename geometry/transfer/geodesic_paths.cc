#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/core/indices.h"
#include "geometry/transfer/surface_roads.h"

namespace deformlab {
namespace {

constexpr double kGroup = 0.5;  // the most by which lengths of a group of paths differ, in roads

// A side of a triangle and the corner opposite to it.
struct Side {
  int a, b;  // a < b
  int opposite;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(const Eigen::Matrix3Xi& T) {
  std::vector<Side> sides;
  for (const auto t : T.colwise()) {
    for (int c = 0; c < 3; ++c) {
      const auto [a, b] = std::minmax({t[(c + 1) % 3], t[(c + 2) % 3]});
      if (a != b) sides.push_back({a, b, t[c]});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

// The position of a point relative to the line from p to q in the plane of the three: the distance
// along the line, and the distance from it.
Eigen::Vector2d unfolded(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                         const Eigen::Vector3d& x) {
  const Eigen::Vector3d along = (q - p).normalized();
  const double t = along.dot(x - p);
  return {t, (x - p - t * along).norm()};
}

// Two triangles with a common side are unfolded into a plane. Appends the straight line between
// their opposite corners, if it crosses that side.
void append_across(const Eigen::Matrix3Xd& V, const Side& one, const Side& other,
                   std::vector<Link>& links) {
  const Eigen::Vector3d p = V.col(one.a), q = V.col(one.b);
  const Eigen::Vector2d x = unfolded(p, q, V.col(one.opposite));
  const Eigen::Vector2d y = unfolded(p, q, V.col(other.opposite));
  const double off = x[1] + y[1];
  if (!(off > 0) || one.opposite == other.opposite) return;
  const double crossing = (x[0] * y[1] + y[0] * x[1]) / off;
  if (crossing < 0 || crossing > (q - p).norm()) return;
  links.push_back({one.opposite, other.opposite, std::hypot(x[0] - y[0], off)});
}

// A path from a source that has reached a vertex.
struct Arrival {
  double distance;
  int source, vertex;
};

// The paths that wait, in groups of nearly the same length, the shortest first.
class Waiting {
 public:
  /// `width` is the difference of lengths that a group may have.
  explicit Waiting(double width) : width_(width) {}

  // No path is shorter than those of the group that was taken last.
  void add(const Arrival& path) {
    const double number = std::min(path.distance / width_, kMostGroups);
    const std::size_t group = std::max(now_, number > 0 ? static_cast<std::size_t>(number) : 0);
    if (group >= groups_.size()) groups_.resize(std::max(group + 1, 2 * groups_.size()));
    groups_[group].push_back(path);
  }
  // The next group, or nothing at the end. What is added to it later is another group.
  std::vector<Arrival> take() {
    while (now_ < groups_.size() && groups_[now_].empty()) ++now_;
    return now_ < groups_.size() ? std::exchange(groups_[now_], {}) : std::vector<Arrival>();
  }

 private:
  static constexpr double kMostGroups = 1 << 20;

  const double width_;
  std::size_t now_ = 0;
  std::vector<std::vector<Arrival>> groups_;
};

// Enters a path from a source to a vertex. Returns whether it is among the nearest that are known.
bool improve(NearestSources& nearest, const Arrival& path) {
  const auto [distance, source, vertex] = path;
  auto sources = nearest.sources.col(vertex);
  auto distances = nearest.distances.col(vertex);
  int& found = nearest.found[vertex];
  const auto is_before = [&](int a) {
    return std::pair(distances[a], sources[a]) < std::pair(path.distance, path.source);
  };
  const int count = static_cast<int>(distances.size());
  if (found == count && is_before(count - 1)) return false;
  int old = 0;  // where the source stands
  while (old < found && sources[old] != source) ++old;
  if (old < found && distances[old] <= distance) return false;
  if (old == found) found = std::min(found + 1, count);
  int at = std::min(old, found - 1);
  for (; at > 0 && !is_before(at - 1); --at) {
    distances[at] = distances[at - 1];
    sources[at] = sources[at - 1];
  }
  distances[at] = distance;
  sources[at] = source;
  return true;
}

// Whether a path is still the shortest that is known from its source, and among the nearest.
bool holds(const NearestSources& nearest, const Arrival& path) {
  for (int a = 0; a < nearest.found[path.vertex]; ++a) {
    if (nearest.sources(a, path.vertex) == path.source) {
      return nearest.distances(a, path.vertex) == path.distance;
    }
  }
  return false;
}

}  // namespace

std::vector<Link> surface_links(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  std::vector<Link> links;
  const std::vector<Side> sides = sides_of(T);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto [a, b, opposite] = sides[s];
    const bool again = s > 0 && sides[s - 1].a == a && sides[s - 1].b == b;
    if (again)
      append_across(V, sides[s - 1], sides[s], links);
    else
      links.push_back({a, b, (V.col(a) - V.col(b)).norm()});
  }
  return links;
}

Roads::Roads(Eigen::Index vertices, const std::vector<Link>& links) : first_(vertices + 1, 0) {
  for (const Link& link : links) ++first_[link.a + 1], ++first_[link.b + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  roads_.resize(2 * links.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const auto& [a, b, length] : links) {
    roads_[next[a]++] = {b, length};
    roads_[next[b]++] = {a, length};
  }
}

double Roads::mean_length() const {
  double sum = 0;
  for (const Road& road : roads_) sum += road.length;
  return sum > 0 ? sum / static_cast<double>(roads_.size()) : 1;
}

// A path is continued from a vertex only if its source is among the nearest there. Where enough
// other sources are nearer, they are also nearer at all vertices that the path would reach. Paths
// of about the same length are continued in the order of their vertices, which are mostly near each
// other in memory then. Some are continued before a shorter one is known, which then replaces them.
NearestSources nearest_by_roads(const Roads& roads, std::span<const int> sources, int count) {
  NearestSources nearest(count, roads.vertices());
  Waiting waiting(kGroup * roads.mean_length());
  const auto enter = [&](const Arrival& path) {
    if (improve(nearest, path)) waiting.add(path);
  };
  for (std::size_t s = 0; s < sources.size(); ++s) {
    enter({0, static_cast<int>(s), sources[s]});
  }
  for (auto group = waiting.take(); !group.empty(); group = waiting.take()) {
    std::ranges::sort(group, {}, [](const Arrival& path) {
      return std::tuple(path.vertex, path.distance, path.source);
    });
    for (const Arrival& path : group) {
      if (!holds(nearest, path)) continue;
      for (const auto& [to, length] : roads.from(path.vertex)) {
        enter({path.distance + length, path.source, to});
      }
    }
  }
  return nearest;
}

NearestSources nearest_along_edges(const Shape& shape, std::span<const int> sources, int count) {
  check_indices(sources, shape.V.cols(), "vertex", "the sources");
  const Roads roads(shape.V.cols(), surface_links(shape.V, triangles(shape)));
  return nearest_by_roads(roads, sources, count);
}

}  // namespace deformlab
