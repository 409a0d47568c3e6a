#include "geometry/graph/placement/thin_out.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <nanoflann.hpp>
#include <queue>
#include <tuple>
#include <vector>

namespace deformlab {
namespace {

/// Finds the nearest point that comes before another one and has not been removed.
class Earlier {
 public:
  explicit Earlier(const Eigen::Matrix3Xd& g)
      : g_(g), tree_(3, g, kLeaf), removed_(static_cast<std::size_t>(g.cols()), 0) {}

  /// The later point, the nearest one before it, and the square of their distance.
  struct Pair {
    double distance;
    int later, earlier;
    bool operator>(const Pair& o) const {
      return std::tie(distance, later) > std::tie(o.distance, o.later);
    }
  };

  Pair nearest(int later) const {
    Search search{{std::numeric_limits<double>::infinity(), later, -1}, *this};
    tree_.index->findNeighbors(search, g_.col(later).data(), {});
    return search.best;
  }

  void remove(int i) { removed_[static_cast<std::size_t>(i)] = 1; }
  bool is_removed(int i) const { return removed_[static_cast<std::size_t>(i)] != 0; }

 private:
  using Tree =
      nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2_Simple, false>;
  static constexpr int kLeaf = 10;
  static constexpr double kRounding = 1 + 1e-12;  // the tree may round distances otherwise

  // The interface of nanoflann to a set of results.
  struct Search {
    Pair best;
    const Earlier& of;
    bool full() const { return true; }
    double worstDist() const { return best.distance * kRounding; }
    bool addPoint(double, Eigen::Index index) {
      const int i = static_cast<int>(index);
      if (i >= best.later || of.is_removed(i)) return true;
      const double distance = (of.g_.col(best.later) - of.g_.col(i)).squaredNorm();
      if (std::tie(distance, i) < std::tie(best.distance, best.earlier)) {
        best.distance = distance, best.earlier = i;
      }
      return true;
    }
  };

  const Eigen::Matrix3Xd& g_;
  Tree tree_;
  std::vector<char> removed_;
};

}  // namespace

void thin_out(Eigen::Matrix3Xd& g, int m) {
  const int count = static_cast<int>(g.cols());
  if (count <= m) return;
  Earlier points(g);
  std::priority_queue<Earlier::Pair, std::vector<Earlier::Pair>, std::greater<>> pairs;
  for (int i = 1; i < count; ++i) pairs.push(points.nearest(i));
  for (int left = count; left > m && !pairs.empty();) {
    const Earlier::Pair pair = pairs.top();
    pairs.pop();
    if (points.is_removed(pair.earlier)) {
      const Earlier::Pair next = points.nearest(pair.later);
      if (next.earlier >= 0) pairs.push(next);
    } else {
      points.remove(pair.later);
      --left;
    }
  }
  std::vector<int> kept;
  for (int i = 0; i < count; ++i) {
    if (!points.is_removed(i)) kept.push_back(i);
  }
  g = Eigen::Matrix3Xd(g(Eigen::all, kept));
}

}  // namespace deformlab
