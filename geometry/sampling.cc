#include "geometry/sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/error.h"

namespace deformlab {
namespace {

constexpr int kDensity = 30;  // dense points for each node that was asked for
constexpr int kFewestDense = 10000;
constexpr int kMostNodes = 100000;  // far beyond what solves in seconds
constexpr int kMostPasses = 100;    // of the search for the radius

Eigen::VectorXd areas(const Shape& shape, const Eigen::Matrix3Xi& T) {
  Eigen::VectorXd result(T.cols());
  for (Eigen::Index i = 0; i < T.cols(); ++i) {
    const Eigen::Vector3d a = shape.V.col(T(1, i)) - shape.V.col(T(0, i));
    const Eigen::Vector3d b = shape.V.col(T(2, i)) - shape.V.col(T(0, i));
    result[i] = a.cross(b).norm() / 2;
  }
  return result;
}

// Uniform over the area. (CGAL's generator draws its barycentric coordinates from a global source,
// so that a seed would not be enough to repeat a run.)
Eigen::Matrix3Xd points_on_triangles(const Shape& shape, const Eigen::Matrix3Xi& T,
                                     const Eigen::VectorXd& area, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::discrete_distribution<Eigen::Index> triangle(area.begin(), area.end());
  std::uniform_real_distribution<double> uniform;
  Eigen::Matrix3Xd result(3, count);
  for (auto point : result.colwise()) {
    const Eigen::Vector3i t = T.col(triangle(random));
    const double root = std::sqrt(uniform(random)), along = uniform(random);
    point = (1 - root) * shape.V.col(t[0]) + root * (1 - along) * shape.V.col(t[1]) +
            root * along * shape.V.col(t[2]);
  }
  return result;
}

// Points taken in a random order, each removing all others within radius r.
class Elimination {
 public:
  Elimination(const Eigen::Matrix3Xd& points, std::uint64_t seed)
      : tree_(3, points, kLeaf), points_(points), order_(points.cols()) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
    std::mt19937_64 random(seed);
    std::shuffle(order_.begin(), order_.end(), random);
  }

  // Squared distances, compared strictly: the least positive number still removes copies.
  std::vector<Eigen::Index> remaining(double r) {
    const double reach = std::max(r * r, std::numeric_limits<double>::min());
    removed_.assign(order_.size(), 0);
    std::vector<Eigen::Index> kept;
    for (const Eigen::Index i : order_) {
      if (removed_[i]) continue;
      kept.push_back(i);
      Remover remover{reach, removed_.data()};
      tree_.index->findNeighbors(remover, points_.col(i).data(), {});
    }
    return kept;
  }

 private:
  using Tree =
      nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2_Simple, false>;
  static constexpr int kLeaf = 32;  // a ball holds about kDensity points

  // What nanoflann asks of a set that it fills.
  struct Remover {
    double reach;
    char* removed;
    bool full() const { return true; }
    double worstDist() const { return reach; }
    bool addPoint(double distance, Eigen::Index i) {
      if (distance < reach) removed[i] = 1;
      return true;
    }
  };

  Tree tree_;
  const Eigen::Matrix3Xd& points_;
  std::vector<Eigen::Index> order_;
  std::vector<char> removed_;
};

Eigen::Matrix3Xd pick(const Eigen::Matrix3Xd& points, const std::vector<Eigen::Index>& indices) {
  return points(Eigen::all, indices);
}

// Drops the points that crowd their nearest neighbour most until m remain.
void thin_out(Eigen::Matrix3Xd& g, int m) {
  std::vector<Eigen::Index> kept(g.cols());
  std::iota(kept.begin(), kept.end(), Eigen::Index{0});
  while (static_cast<int>(kept.size()) > m) {
    std::size_t crowded = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < kept.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double distance = (g.col(kept[a]) - g.col(kept[b])).squaredNorm();
        if (distance < least) least = distance, crowded = a;
      }
    }
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(crowded));
  }
  g = pick(g, kept);
}

std::vector<Eigen::Index> all_distinct(Elimination& elimination, int m) {
  std::vector<Eigen::Index> distinct = elimination.remaining(0);
  if (static_cast<int>(distinct.size()) >= m) return distinct;
  throw InputError("graph.nodes is " + std::to_string(m) + ", but the shape has only " +
                   std::to_string(distinct.size()) + " distinct point" +
                   (distinct.size() == 1 ? "" : "s") + " to place nodes at");
}

// Searches the radius at which m points remain. Their number falls about as r⁻² on a surface; that
// guess is taken while it stays within the bracket, which is halved otherwise.
Eigen::Matrix3Xd eliminate_to(const Eigen::Matrix3Xd& dense, int m, double guess,
                              std::uint64_t seed) {
  Elimination elimination(dense, seed);
  std::vector<Eigen::Index> best;  // at least m
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
  Eigen::Matrix3Xd g = pick(dense, best);
  thin_out(g, m);
  return g;
}

}  // namespace

Eigen::Matrix3Xd sample_nodes(const Shape& shape, int m, std::uint64_t seed) {
  if (m < 1) throw InputError("graph.nodes is " + std::to_string(m) + "; at least 1 is needed");
  if (m > kMostNodes) {
    throw InputError("graph.nodes is " + std::to_string(m) + "; at most " +
                     std::to_string(kMostNodes) + " are possible");
  }
  const Eigen::Matrix3Xi T = triangles(shape);
  const Eigen::VectorXd area = areas(shape, T);
  const double surface = area.sum();
  const int count = std::max(kDensity * m, kFewestDense);
  const Eigen::Matrix3Xd dense =
      surface > 0 ? points_on_triangles(shape, T, area, count, seed) : shape.V;
  const double extent = surface > 0 ? surface : std::pow(bounding_box_diagonal(shape.V), 2);
  return eliminate_to(dense, m, std::sqrt(extent > 0 ? extent / m : 1), seed);
}

}  // namespace deformlab
