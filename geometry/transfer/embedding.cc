#include "geometry/transfer/embedding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/core/error.h"
#include "geometry/core/indices.h"
#include "geometry/transfer/nearest_nodes.h"

namespace deformlab {

void weigh(Eigen::Ref<Eigen::VectorXd> distances, int k) {
  const double d_max = distances[k];
  auto w = distances.head(k);
  if (d_max > 0) w = (1 - w.array() / d_max).square();
  const double sum = w.sum();
  if (d_max > 0 && sum > 0) {
    w /= sum;
  } else {
    w.setConstant(1.0 / k);
  }
}

Embedding embed(const Eigen::Matrix3Xd& v, const Eigen::Matrix3Xd& g, int k) {
  if (g.cols() == 0) throw InputError("a deformation graph without nodes can deform nothing");
  check_number("neighbors", k, kNeighborRange);
  if (!v.allFinite() || !g.allFinite()) {
    throw InputError("a point or a node of an embedding is not finite; every number must be");
  }
  const int m = static_cast<int>(g.cols());
  const int n = static_cast<int>(v.cols());
  const int nearest = std::min(k + 1, m);
  k = std::max(1, nearest - 1);
  Embedding result{v, Eigen::MatrixXi(k, n), Eigen::MatrixXd(k, n)};

  NearestNodes nearest_nodes(g, nearest);
  Eigen::VectorXd distances(k + 1);
  Eigen::VectorXi found(k + 1);
  for (int i = 0; i < n; ++i) {
    nearest_nodes.find(v.col(i), found.data(), distances.data());
    if (nearest == k)
      distances[k] = 2 * distances[0] + 1;  // a single node has weight 1 for any d_max
    weigh(distances, k);
    result.nodes.col(i) = found.head(k);
    result.weights.col(i) = distances.head(k);
  }
  return result;
}

void check(const Embedding& embedding, Eigen::Index m) {
  const Eigen::Index n = embedding.v.cols(), k = embedding.nodes.rows();
  const bool fits =
      embedding.nodes.cols() == n && embedding.weights.cols() == n && embedding.weights.rows() == k;
  if (!fits) {
    throw InputError(fmt::format(
        "an embedding has {} points, {}x{} nodes and {}x{} weights; nodes and weights "
        "have one column for each point and the same number of rows",
        n, k, embedding.nodes.cols(), embedding.weights.rows(), embedding.weights.cols()));
  }
  check_indices({embedding.nodes.data(), std::size_t(k * n)}, m, "node", "the points");
  if (!std::isfinite(embedding.weights.sum()))
    throw InputError("a weight of an embedding is not finite");
}

Embedding joined(const Embedding& first, const Embedding& second) {
  if (first.nodes.rows() != second.nodes.rows()) {
    throw InputError(fmt::format("embeddings with {} and {} nodes for each point cannot be joined",
                                 first.nodes.rows(), second.nodes.rows()));
  }
  const Eigen::Index k = first.nodes.rows(), n = first.v.cols() + second.v.cols();
  Embedding result{Eigen::Matrix3Xd(3, n), Eigen::MatrixXi(k, n), Eigen::MatrixXd(k, n)};
  result.v << first.v, second.v;
  result.nodes << first.nodes, second.nodes;
  result.weights << first.weights, second.weights;
  return result;
}

Embedding subset(const Embedding& embedding, std::span<const int> indices) {
  check_indices(indices, embedding.v.cols(), "point", "the indices");
  const auto n = static_cast<Eigen::Index>(indices.size());
  const Eigen::Index k = embedding.nodes.rows();
  Embedding result{Eigen::Matrix3Xd(3, n), Eigen::MatrixXi(k, n), Eigen::MatrixXd(k, n)};
  for (Eigen::Index l = 0; l < n; ++l) {
    const int i = indices[static_cast<std::size_t>(l)];
    result.v.col(l) = embedding.v.col(i);
    result.nodes.col(l) = embedding.nodes.col(i);
    result.weights.col(l) = embedding.weights.col(i);
  }
  return result;
}

}  // namespace deformlab
