#include "geometry/graph/graph_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <nanoflann.hpp>
#include <string>

#include "geometry/core/options.h"

namespace deformlab {
namespace {

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2, false>;

// The `count` vertices nearest to a point, nearest first.
std::vector<Eigen::Index> nearest(const Tree& tree, const Eigen::Vector3d& point,
                                  std::size_t count) {
  std::vector<Eigen::Index> found(count);
  std::vector<double> distances(count);
  tree.query(point.data(), count, found.data(), distances.data());
  return found;
}

int nearest_free(const Tree& tree, const Eigen::Vector3d& point, const std::vector<char>& taken) {
  for (std::size_t count = 1;; count = std::min(2 * count, taken.size())) {
    for (const Eigen::Index i : nearest(tree, point, count)) {
      if (!taken[i]) return static_cast<int>(i);
    }
  }
}

}  // namespace

std::vector<int> nearest_vertices(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& V) {
  if (points.cols() == 0) return {};  // without the time to build the tree
  const Tree tree(3, V);
  std::vector<int> result;
  for (const auto point : points.colwise()) {
    result.push_back(static_cast<int>(nearest(tree, point, 1).front()));
  }
  return result;
}

std::vector<int> distinct_nearest_vertices(const Eigen::Matrix3Xd& points,
                                           const Eigen::Matrix3Xd& V) {
  if (points.cols() > V.cols()) {
    throw OptionError(
        "nodes", std::to_string(points.cols()),
        fmt::format(", but the shape has {} vertices for them to sit on; use fewer", V.cols()));
  }
  const Tree tree(3, V);
  std::vector<char> taken(static_cast<std::size_t>(V.cols()), 0);
  std::vector<int> result;
  for (const auto point : points.colwise()) {
    result.push_back(nearest_free(tree, point, taken));
    taken[result.back()] = 1;
  }
  return result;
}

}  // namespace deformlab
