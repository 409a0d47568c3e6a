#include "geometry/transfer/nearest_nodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nanoflann.hpp>

namespace deformlab {
namespace {

constexpr int kKnown = 6;            // stored neighbors of a node per node that a search returns
constexpr double kSlack = 1 + 1e-9;  // a factor far above rounding

// Adds in the same order as nanoflann, so that both have the same rounding errors.
double square_distance(const Eigen::Vector3d& v, const Eigen::Vector3d& g) {
  const double x = v[0] - g[0], y = v[1] - g[1], z = v[2] - g[2];
  return x * x + y * y + z * z;
}

// Inserts into sorted arrays at or before index `at`; the entry at this index is overwritten.
void insert(double square, int node, double* squares, int* nodes, int at) {
  for (; at > 0 && squares[at - 1] > square; --at) {
    squares[at] = squares[at - 1], nodes[at] = nodes[at - 1];
  }
  squares[at] = square, nodes[at] = node;
}

}  // namespace

struct NearestNodes::Tree
    : nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2, false> {
  using KDTreeEigenMatrixAdaptor::KDTreeEigenMatrixAdaptor;
};

NearestNodes::NearestNodes(const Eigen::Matrix3Xd& g, int count)
    : g_(g),
      count_(count),
      tree_(std::make_unique<Tree>(3, g)),
      neighbors_(g.cols()),
      squares_(count + 1),
      nodes_(count + 1) {}

NearestNodes::~NearestNodes() = default;

void NearestNodes::find(const Eigen::Vector3d& v, int* nodes, double* distances) {
  if (last_ < 0 || !find_near(v)) query(v, count_, nodes_.data(), squares_.data());
  for (int a = 0; a < count_; ++a) nodes[a] = nodes_[a], distances[a] = std::sqrt(squares_[a]);
  last_ = nodes[0];
}

// A node at distance D from the last point's nearest node is at least D − |v − g_last| away from v.
// Where nodes are equally far, false is returned, because the tree decides their order.
bool NearestNodes::find_near(const Eigen::Vector3d& v) {
  const double offset = kSlack * (v - g_.col(last_)).norm();
  const std::vector<Neighbor>& near = neighbors(last_);
  if (offset > near.back().distance / 2) return false;  // too few neighbors are stored
  double* const squares = squares_.data();
  int found = 0;
  for (const auto& [distance, node] : near) {
    const double least = distance - offset;
    if (found > count_ && least > 0 && least * least > kSlack * squares[count_]) {
      return std::ranges::adjacent_find(squares_, std::greater_equal()) == squares_.end();
    }
    const double square = square_distance(v, g_.col(node));
    if (found <= count_) {
      insert(square, node, squares, nodes_.data(), found++);
    } else if (square < squares[count_]) {
      insert(square, node, squares, nodes_.data(), count_);
    }
  }
  return false;
}

void NearestNodes::query(const Eigen::Vector3d& v, int count, int* nodes, double* squares) {
  found_.resize(count);
  tree_->query(v.data(), count, found_.data(), squares);
  std::ranges::copy(found_, nodes);
}

const std::vector<NearestNodes::Neighbor>& NearestNodes::neighbors(int j) {
  std::vector<Neighbor>& result = neighbors_[j];
  if (!result.empty()) return result;
  const int count = std::min(kKnown * count_, static_cast<int>(g_.cols()));
  std::vector<int> nodes(count);
  std::vector<double> squares(count);
  query(g_.col(j), count, nodes.data(), squares.data());
  for (int a = 0; a < count; ++a) result.push_back({std::sqrt(squares[a]), nodes[a]});
  return result;
}

}  // namespace deformlab
