#include "experiments/measure/shortfalls.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "deformers/embedded/handles/handle_groups.h"
#include "experiments/measure/drag.h"
#include "geometry/core/error.h"
#include "geometry/core/median.h"
#include "geometry/shape/weld.h"

namespace deformlab {
namespace {

constexpr double kMissed = 0.02;    // of the edit's motion
constexpr double kRounding = 1e-6;  // of the shape's diagonal
constexpr double kTorn = 5;         // times the stretch around an edge
constexpr double kOpen = 0.5;       // mean sides of faces between the two sides of a seam

using Edge = std::pair<int, int>;

// Calls visit(edge) for every side of every face, so that most edges come twice.
template <class Visit>
void for_each_side(const Shape& shape, Visit&& visit) {
  for (const auto& face : shape.faces) {
    for (std::size_t c = 0; c < face.size(); ++c) {
      visit(Edge(std::minmax(face[c], face[(c + 1) % face.size()])));
    }
  }
}

void sort_out(std::vector<Edge>& edges) {
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

double length(const Eigen::Matrix3Xd& V, const Edge& edge) {
  return (V.col(edge.first) - V.col(edge.second)).norm();
}

// The mean length of the faces' sides at rest.
double mean_side(const Shape& rest) {
  double sum = 0;
  std::size_t count = 0;
  for_each_side(rest, [&](const Edge& edge) { sum += length(rest.V, edge), ++count; });
  return sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

// The stretch of edges: their lengths divided by those at rest.
class Stretch {
 public:
  Stretch(const Shape& rest, const Eigen::Matrix3Xd& V) : rest_(rest), V_(V) {}

  struct Worst {
    int count = 0;
    double times = 0;
    Edge edge;
  };

  Worst torn() {
    std::vector<Edge> long_ones;  // few, so that the surroundings of most edges need no look
    for_each_side(rest_, [&](const Edge& edge) {
      if (of(edge) > kTorn) long_ones.push_back(edge);
    });
    sort_out(long_ones);
    if (!long_ones.empty()) find_neighbors();
    Worst worst;
    for (const Edge& edge : long_ones) {
      const double times = of(edge) / std::max(1.0, around(edge));
      if (!(times > kTorn)) continue;
      ++worst.count;
      if (times > worst.times) worst.times = times, worst.edge = edge;
    }
    return worst;
  }

 private:
  double of(const Edge& edge) const {
    const double before = length(rest_.V, edge);
    return before > 0 ? length(V_, edge) / before : 1;
  }

  void find_neighbors() {
    std::vector<Edge> edges;
    for_each_side(rest_, [&](const Edge& edge) { edges.push_back(edge); });
    sort_out(edges);
    neighbors_.resize(static_cast<std::size_t>(rest_.V.cols()));
    for (const Edge& edge : edges) {
      neighbors_[edge.first].push_back(edge.second);
      neighbors_[edge.second].push_back(edge.first);
    }
  }

  // The median stretch of the edges that start at neighbours of an edge, but not at the edge
  // itself.
  double around(const Edge& edge) const {
    const auto is_end = [&](int i) { return i == edge.first || i == edge.second; };
    std::vector<double> stretches;
    for (const int end : {edge.first, edge.second}) {
      for (const int near : neighbors_[end]) {
        for (const int far : neighbors_[near]) {
          if (!is_end(near) && !is_end(far)) stretches.push_back(of({near, far}));
        }
      }
    }
    return stretches.empty() ? 1 : median(stretches);
  }

  const Shape& rest_;
  const Eigen::Matrix3Xd& V_;
  std::vector<std::vector<int>> neighbors_;
};

// Whether two vertices are on different sides of a cut, so that they may part.
class OnTwoSides {
 public:
  OnTwoSides(Eigen::Index vertices, std::span<const Cut> cuts) {
    for (const Cut& cut : cuts) {
      std::vector<char>& side = sides_.emplace_back(static_cast<std::size_t>(vertices), 0);
      for (const int i : cut.a) side[i] = 1;
      for (const int i : cut.b) side[i] = 2;
    }
  }
  bool operator()(int i, int j) const {
    return std::ranges::any_of(sides_, [&](const auto& side) { return (side[i] | side[j]) == 3; });
  }

 private:
  std::vector<std::vector<char>> sides_;  // 1 or 2 for each vertex, or 0 on neither
};

// The longest way of a handle that turns with its group about the group's centroid. After a full
// turn it is where it was, but it has moved.
double longest_arc(const Eigen::Matrix3Xd& from, const Handles& handles) {
  if (handles.rotations.cols() == 0) return 0;
  double longest = 0;
  for (std::vector<int>& group : handle_groups(from.cols(), handles.groups)) {
    std::erase_if(group, [&](int l) { return !handles.rotations.col(l).allFinite(); });
    if (group.empty()) continue;
    const Eigen::Vector3d centroid = from(Eigen::all, group).rowwise().mean();
    for (const int l : group) {
      const Eigen::Vector3d arm = from.col(l) - centroid, turn = handles.rotations.col(l);
      longest = std::max(longest, turn.cross(arm).norm());  // the angle times the distance
    }
  }
  return longest;
}

}  // namespace

double edit_motion(const Shape& rest, const Handles& handles, const Eigen::Matrix3Xd& targets) {
  if (targets.cols() == 0) return 0;
  const Eigen::Matrix3Xd from = targets_at_rest(rest, handles);
  return std::max((targets - from).colwise().norm().maxCoeff(), longest_arc(from, handles));
}

double allowed_miss(double motion, double size) {
  return std::max(kMissed * motion, kRounding * size);
}

std::vector<std::string> missed_handles(const Shape& rest, const Eigen::Matrix3Xd& V,
                                        const Handles& handles, const Eigen::Matrix3Xd& targets,
                                        const Report& report) {
  std::vector<std::string> result = report.undone;
  const double motion = edit_motion(rest, handles, targets);
  const double allowed = allowed_miss(motion, bounding_box_diagonal(rest.V));
  if (!(report.handle_max > allowed)) return result;
  int count = 0, worst = -1;
  double most = 0;
  for (std::size_t l = 0; l < handles.moved.size(); ++l) {
    const double miss = (V.col(handles.moved[l]) - targets.col(l)).norm();
    count += miss > kMissed * motion;
    if (miss > most) most = miss, worst = handles.moved[l];
  }
  const bool is_point = !(most > kMissed * motion);
  const std::string which =
      is_point ? "a handle at a point" : fmt::format("the handle at vertex {}", worst);
  const std::string others =
      count > 1 ? fmt::format(" ({} handles miss by more than 2 %)", count) : "";
  const double miss = is_point ? report.handle_max : most;
  result.push_back(
      fmt::format("{} stops {:.3g} short of its target, {:.0f} % of the edit's motion{}; {}", which,
                  miss, 100 * miss / motion, others, report.advice.missed));
  return result;
}

std::vector<std::string> tears(const Shape& rest, const Eigen::Matrix3Xd& V, const Report& report,
                               std::span<const Cut> cuts) {
  std::vector<std::string> result;
  const auto [count, times, edge] = Stretch(rest, V).torn();
  if (count > 0) {
    result.push_back(fmt::format(
        "the shape tears at {} edge{}: the edge of vertices {} and {} becomes {:.3g} times as long "
        "as those around it; {}",
        count, count == 1 ? "" : "s", edge.first, edge.second, times, report.advice.torn));
  }
  const std::vector<int> first = weld(rest.V);
  const double allowed = kOpen * mean_side(rest);
  const OnTwoSides are_cut(rest.V.cols(), cuts);
  int open = 0;
  double widest = 0;
  for (int i = 0; i < rest.V.cols(); ++i) {
    if (first[i] == i || are_cut(i, first[i])) continue;
    const double gap = (V.col(i) - V.col(first[i])).norm();
    open += gap > allowed && gap > 0;
    widest = std::max(widest, gap);
  }
  if (open > 0 && !rest.faces.empty()) {
    result.push_back(fmt::format(
        "a seam opens: {} vertices that are at the position of another one move up to {:.3g} away "
        "from it; {}",
        open, widest, report.advice.open_seam));
  }
  return result;
}

std::vector<std::string> inside_out(const Report& report) {
  if (report.inside_out == 0) return {};
  return {fmt::format("the shape is turned inside out around {} of {} nodes; {}", report.inside_out,
                      report.nodes, report.advice.inside_out)};
}

void check_movable(const Shape& rest, const Handles& handles, const Eigen::Matrix3Xd& targets,
                   const Report& report) {
  if (targets.cols() > 0 && std::ssize(handles.fixed) == rest.V.cols()) {
    throw InputError(fmt::format(
        "the edit fixes all {} vertices, so that nothing can move; fix fewer", rest.V.cols()));
  }
  const bool asks = edit_motion(rest, handles, targets) > 0;
  if (!asks || report.immovable < targets.cols()) return;
  throw InputError(fmt::format(
      "no handle can move, because all {} follow only nodes that the fixed part holds; {}",
      targets.cols(), report.advice.immovable));
}

}  // namespace deformlab
