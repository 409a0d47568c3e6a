#include "geometry/sampling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
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
Eigen::Matrix3Xd points_on_triangles(const Shape& shape, const Eigen::Matrix3Xi& T, int count,
                                     std::uint64_t seed) {
  const Eigen::VectorXd area = areas(shape, T);
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

// The points of which no other is near yet, taken in a random order: those that remain when each
// chosen point removes all within radius r.
class Elimination {
 public:
  Elimination(const Eigen::Matrix3Xd& points, std::uint64_t seed)
      : points_(points), order_(points.cols()), next_(points.cols()) {
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
    std::mt19937_64 random(seed);
    std::shuffle(order_.begin(), order_.end(), random);
    std::size_t size = 1024;
    while (size < static_cast<std::size_t>(points.cols())) size *= 2;
    first_.resize(size);
    low_ = points.rowwise().minCoeff();
    extent_ = (points.rowwise().maxCoeff() - low_).maxCoeff();
  }

  // Chosen points are kept by cells of side r, so that only those around have to be looked at.
  std::vector<Eigen::Index> remaining(double r) {
    // Squared distances, compared strictly: the least positive number still removes copies.
    const double reach = std::max(r * r, std::numeric_limits<double>::min());
    const double side = std::max({r, kLeastCell * extent_, std::numeric_limits<double>::min()});
    std::fill(first_.begin(), first_.end(), Eigen::Index{-1});
    std::vector<Eigen::Index> kept;
    for (const Eigen::Index i : order_) {
      const Cell cell = ((points_.col(i) - low_) / side).array().floor().cast<std::int64_t>();
      if (any_near(i, cell, reach)) continue;
      const std::size_t at = slot(cell);
      next_[i] = std::exchange(first_[at], i);
      kept.push_back(i);
    }
    return kept;
  }

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
  static constexpr double kLeastCell = 1e-15;  // of the extent: what cells can be counted with

  // Cells that share a slot only add points that are too far.
  std::size_t slot(const Cell& cell) const {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
      h = (h ^ static_cast<std::uint64_t>(cell[i])) * 0x9e3779b97f4a7c15;
      h ^= h >> 29;
    }
    return h & (first_.size() - 1);
  }

  bool any_near(Eigen::Index i, const Cell& cell, double reach) const {
    for (const Cell& step : around()) {
      for (Eigen::Index k = first_[slot(cell + step)]; k >= 0; k = next_[k]) {
        if ((points_.col(k) - points_.col(i)).squaredNorm() < reach) return true;
      }
    }
    return false;
  }

  // The cell itself first, then the others, those that share a face with it before the corners.
  static const std::vector<Cell>& around() {
    static const std::vector<Cell> steps = [] {
      std::vector<Cell> result;
      for (int i = 0; i < 27; ++i) result.emplace_back(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      std::stable_sort(result.begin(), result.end(), [](const Cell& a, const Cell& b) {
        return a.squaredNorm() < b.squaredNorm();
      });
      return result;
    }();
    return steps;
  }

  const Eigen::Matrix3Xd& points_;
  std::vector<Eigen::Index> order_;
  std::vector<Eigen::Index> first_, next_;  // chosen points of each slot, one after another
  Eigen::Vector3d low_;
  double extent_ = 0;
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

// Searches the radius at which m points remain. Their number falls about as r⁻² on a surface; that
// guess is taken while it stays within the bracket, which is halved otherwise.
Eigen::Matrix3Xd eliminate_to(const Eigen::Matrix3Xd& dense, int m, double guess,
                              std::uint64_t seed) {
  Elimination elimination(dense, seed);
  std::vector<Eigen::Index> best = elimination.remaining(0);
  if (static_cast<int>(best.size()) < m) {
    throw InputError("graph.nodes is " + std::to_string(m) + ", but the shape has only " +
                     std::to_string(best.size()) + " distinct point" +
                     (best.size() == 1 ? "" : "s") + " to place nodes at");
  }
  double low = 0, high = std::numeric_limits<double>::infinity(), r = guess;
  for (int pass = 0; pass < kMostPasses && static_cast<int>(best.size()) != m; ++pass) {
    const auto kept = elimination.remaining(r);
    const int count = static_cast<int>(kept.size());
    (count >= m ? low : high) = r;
    if (count >= m && count <= static_cast<int>(best.size())) best = kept;
    const double scaled = r * std::sqrt(static_cast<double>(count) / m);
    const bool inside = pass < kMostPasses / 4 && scaled > low && scaled < high;
    r = inside ? scaled : std::isinf(high) ? 2 * low : (low + high) / 2;
  }
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
  const double surface = areas(shape, T).sum();
  const int count = std::max(kDensity * m, kFewestDense);
  const Eigen::Matrix3Xd dense = surface > 0 ? points_on_triangles(shape, T, count, seed) : shape.V;
  const double extent = surface > 0 ? surface : std::pow(bounding_box_diagonal(shape.V), 2);
  return eliminate_to(dense, m, std::sqrt(extent > 0 ? extent / m : 1), seed);
}

}  // namespace deformlab
