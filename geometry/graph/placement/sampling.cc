#include "geometry/graph/placement/sampling.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/graph/deformation_graph.h"
#include "geometry/graph/placement/loose_vertices.h"
#include "geometry/graph/placement/thin_out.h"

namespace deformlab {
namespace {

constexpr int kDensity = 30;  // dense points per node
constexpr int kFewestDense = 10000;
constexpr int kMostPasses = 100;  // of the search for the radius

Eigen::VectorXd areas(const Shape& shape, const Eigen::Matrix3Xi& T) {
  Eigen::VectorXd result(T.cols());
  for (Eigen::Index i = 0; i < T.cols(); ++i) {
    const Eigen::Vector3d a = shape.V.col(T(1, i)) - shape.V.col(T(0, i));
    const Eigen::Vector3d b = shape.V.col(T(2, i)) - shape.V.col(T(0, i));
    result[i] = a.cross(b).norm() / 2;
  }
  return result;
}

// Points in an order that is coherent in space where possible; drawn[i] is the index of the point
// that was drawn as the i-th.
struct Dense {
  Eigen::Matrix3Xd points;
  std::vector<int> drawn;
};

struct Draw {
  double triangle, root, along;  // uniform numbers; root is the square root of one
  int number;
};

// Draws no number for the choice among one triangle, like std::discrete_distribution.
std::vector<Draw> draws(int count, bool one_triangle, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<Draw> result(count);
  for (int i = 0; i < count; ++i) {
    Draw& draw = result[i];
    draw.triangle = one_triangle ? 0 : uniform(random);
    draw.root = std::sqrt(uniform(random)), draw.along = uniform(random), draw.number = i;
  }
  return result;
}

// Points that are uniform over the area. They are those that std::discrete_distribution would draw,
// but in the order of their triangles, so that the shares of the triangles are summed once. CGAL's
// generator is not used, because it draws barycentric coordinates from a global source, and a seed
// would not suffice to repeat a run.
Dense points_on_triangles(const Shape& shape, const Eigen::Matrix3Xi& T,
                          const Eigen::VectorXd& area, int count, std::uint64_t seed) {
  std::vector<Draw> all = draws(count, T.cols() == 1, seed);
  std::sort(all.begin(), all.end(),
            [](const Draw& a, const Draw& b) { return a.triangle < b.triangle; });
  const double surface = std::accumulate(area.begin(), area.end(), 0.0);
  Dense dense{Eigen::Matrix3Xd(3, count), std::vector<int>(count)};
  Eigen::Index at = 0;
  double share = area[0] / surface;  // of all triangles up to `at`
  for (int i = 0; i < count; ++i) {
    const auto& [triangle, root, along, number] = all[i];
    while (share < triangle && at + 1 < T.cols()) share += area[++at] / surface;
    const Eigen::Vector3i t = T.col(at);
    dense.points.col(i) = (1 - root) * shape.V.col(t[0]) + root * (1 - along) * shape.V.col(t[1]) +
                          root * along * shape.V.col(t[2]);
    dense.drawn[number] = i;
  }
  return dense;
}

Dense own_points(const Shape& shape) {
  Dense dense{shape.V, std::vector<int>(shape.V.cols())};
  std::iota(dense.drawn.begin(), dense.drawn.end(), 0);
  return dense;
}

// Adds the vertices that have no face.
void add_loose_points(const Shape& shape, Dense& dense) {
  const std::vector<int> loose = loose_vertices(shape);
  const Eigen::Index before = dense.points.cols();
  dense.points.conservativeResize(3, before + std::ssize(loose));
  dense.points.rightCols(std::ssize(loose)) = shape.V(Eigen::all, loose);
  dense.drawn.resize(dense.points.cols());
  std::iota(dense.drawn.begin() + before, dense.drawn.end(), static_cast<int>(before));
}

// Takes points in a random order; each point that is taken removes all others within radius r.
class Elimination {
 public:
  Elimination(const Dense& dense, std::uint64_t seed)
      : tree_(3, dense.points, kLeaf), points_(dense.points), order_(dense.drawn) {
    std::mt19937_64 random(seed);
    std::shuffle(order_.begin(), order_.end(), random);
  }

  // Squared distances are compared strictly, so that a tiny positive radius still removes copies.
  std::vector<int> remaining(double r) {
    const double reach = std::max(r * r, std::numeric_limits<double>::min());
    if (neighbors_.size() > kMostNeighbors * order_.size()) forget();
    std::vector<char> removed(order_.size(), 0);
    std::vector<int> kept;
    for (const int i : order_) {
      if (removed[i]) continue;
      kept.push_back(i);
      for (const Neighbor& other : neighbors(i, reach)) {
        if (other.distance < reach) removed[other.index] = 1;
      }
    }
    return kept;
  }

 private:
  using Tree =
      nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2_Simple, false>;
  static constexpr int kLeaf = 32;                  // a ball holds about kDensity points
  static constexpr double kMargin = 1.01;           // of squared distances
  static constexpr std::size_t kMostNeighbors = 4;  // kept for each point

  struct Neighbor {
    double distance;  // squared
    int index;
  };
  // The neighbors of one point that are nearer than `reach`: a range of neighbors_.
  struct Ball {
    double reach = 0;
    std::size_t begin = 0, end = 0;
  };
  // The interface of nanoflann to a set of results.
  struct Collector {
    double reach;
    std::vector<Neighbor>& found;
    bool full() const { return true; }
    double worstDist() const { return reach; }
    bool addPoint(double distance, Eigen::Index i) {
      found.push_back({distance, static_cast<int>(i)});
      return true;
    }
  };

  // All points that are nearer than `reach`, and possibly some more. The passes have nearly the
  // same radius and keep nearly the same points, so that most balls are known from earlier passes.
  std::span<const Neighbor> neighbors(int i, double reach) {
    Ball& ball = balls_[i];
    if (ball.reach < reach) {
      ball.reach = kMargin * reach, ball.begin = neighbors_.size();
      Collector collector{ball.reach, neighbors_};
      tree_.index->findNeighbors(collector, points_.col(i).data(), {});
      ball.end = neighbors_.size();
    }
    return {neighbors_.data() + ball.begin, ball.end - ball.begin};
  }

  void forget() {
    std::ranges::fill(balls_, Ball{});
    neighbors_.clear();
  }

  Tree tree_;
  const Eigen::Matrix3Xd& points_;
  std::vector<int> order_;
  std::vector<Ball> balls_ = std::vector<Ball>(order_.size());
  std::vector<Neighbor> neighbors_;
};

Eigen::Matrix3Xd pick(const Eigen::Matrix3Xd& points, const std::vector<int>& indices) {
  return points(Eigen::all, indices);
}

std::vector<int> all_distinct(Elimination& elimination, int m) {
  std::vector<int> distinct = elimination.remaining(0);
  if (static_cast<int>(distinct.size()) >= m) return distinct;
  throw OptionError("nodes", std::to_string(m),
                    fmt::format(", but the shape has only {} distinct point{} to place nodes at",
                                distinct.size(), distinct.size() == 1 ? "" : "s"));
}

// Searches the radius at which m points remain. On a surface, their number falls about as r⁻². The
// guess by this rule is taken while it stays within the bracket; otherwise the bracket is halved.
Eigen::Matrix3Xd eliminate_to(const Dense& dense, int m, double guess, std::uint64_t seed) {
  Elimination elimination(dense, seed);
  std::vector<int> best;  // the fewest points that are at least m
  double low = 0, high = std::numeric_limits<double>::infinity(), r = guess;
  for (int pass = 0; pass < kMostPasses && static_cast<int>(best.size()) != m; ++pass) {
    auto kept = elimination.remaining(r);
    const int count = static_cast<int>(kept.size());
    (count >= m ? low : high) = r;
    if (count >= m && (best.empty() || kept.size() <= best.size())) best = std::move(kept);
    const double scaled = r * std::sqrt(static_cast<double>(count) / m);
    const bool inside = pass < kMostPasses / 4 && scaled > low && scaled < high;
    r = inside ? scaled : std::isinf(high) ? 2 * low : (low + high) / 2;
  }
  if (best.empty()) best = all_distinct(elimination, m);
  Eigen::Matrix3Xd g = pick(dense.points, best);
  thin_out(g, m);
  return g;
}

}  // namespace

Eigen::Matrix3Xd sample_nodes(const Shape& shape, int m, std::uint64_t seed, bool everything) {
  check_number("nodes", m, kNodeRange);
  check(shape, "the shape");
  const Eigen::Matrix3Xi T = triangles(shape);
  const Eigen::VectorXd area = areas(shape, T);
  const double surface = area.sum();
  const int count = std::max(kDensity * m, kFewestDense);
  Dense dense = surface > 0 ? points_on_triangles(shape, T, area, count, seed) : own_points(shape);
  if (everything && surface > 0) add_loose_points(shape, dense);
  const double extent = surface > 0 ? surface : std::pow(bounding_box_diagonal(shape.V), 2);
  return eliminate_to(dense, m, std::sqrt(extent > 0 ? extent / m : 1), seed);
}

}  // namespace deformlab
