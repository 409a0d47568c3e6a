#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>

#include "geometry/transfer/surface_roads.h"

namespace deformlab {
namespace {

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
  friend auto operator<=>(const Arrival&, const Arrival&) = default;
};

bool is_full(const NearestSources& nearest, int vertex) {
  return nearest.found[vertex] == nearest.sources.rows();
}

bool has(const NearestSources& nearest, int vertex, int source) {
  const auto known = nearest.sources.col(vertex).head(nearest.found[vertex]);
  return std::find(known.begin(), known.end(), source) != known.end();
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

// A path is continued from a vertex only if its source is among the nearest there. Where enough
// other sources are nearer, they are also nearer at all vertices that the path would reach.
NearestSources nearest_by_roads(const Roads& roads, std::span<const int> sources, int count) {
  NearestSources nearest(count, roads.vertices());
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> queue;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    queue.push({0, static_cast<int>(s), sources[s]});
  }
  while (!queue.empty()) {
    const auto [distance, source, vertex] = queue.top();
    queue.pop();
    if (is_full(nearest, vertex) || has(nearest, vertex, source)) continue;
    nearest.insert(vertex, source, distance);
    for (const auto& [to, length] : roads.from(vertex)) {
      if (is_full(nearest, to) || has(nearest, to, source)) continue;
      queue.push({distance + length, source, to});
    }
  }
  return nearest;
}

NearestSources nearest_along_edges(const Shape& shape, std::span<const int> sources, int count) {
  const Roads roads(shape.V.cols(), surface_links(shape.V, triangles(shape)));
  return nearest_by_roads(roads, sources, count);
}

}  // namespace deformlab
