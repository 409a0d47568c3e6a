#include "deformers/arap_2d/handle_clusters.h"

#include <Eigen/SVD>
#include <algorithm>

#include "geometry/core/disjoint_sets.h"

namespace deformlab {
namespace {

constexpr double kLeastSingularValue = 1e-6;  // smaller singular values of C count as 0

// The number of each point's cluster. Points that share vertices are in the same cluster.
std::vector<int> number_clusters(const std::vector<BarycentricPoint>& points,
                                 Eigen::Index vertices) {
  DisjointSets sets(std::ssize(points));
  std::vector<int> at_vertex(vertices, -1);
  for (int i = 0; i < std::ssize(points); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (points[i].b[c] == 0) continue;
      int& other = at_vertex[points[i].vertices[c]];
      if (other < 0) {
        other = i;
      } else {
        sets.join(i, other);
      }
    }
  }
  return sets.numbered();
}

// `column` maps each vertex to its column of C, and is −1 for vertices without one so far.
void decompose(const std::vector<BarycentricPoint>& points, std::vector<int>& column,
               HandleCluster& cluster) {
  for (const int i : cluster.points) {
    for (int c = 0; c < 3; ++c) {
      const int v = points[i].vertices[c];
      if (points[i].b[c] == 0 || column[v] >= 0) continue;
      column[v] = static_cast<int>(cluster.vertices.size());
      cluster.vertices.push_back(v);
    }
  }
  Eigen::MatrixXd C =
      Eigen::MatrixXd::Zero(std::ssize(cluster.points), std::ssize(cluster.vertices));
  for (Eigen::Index row = 0; row < C.rows(); ++row) {
    const BarycentricPoint& point = points[cluster.points[row]];
    for (int c = 0; c < 3; ++c) {
      if (point.b[c] != 0) C(row, column[point.vertices[c]]) += point.b[c];
    }
  }
  if (C.size() == 1) {
    cluster.V = cluster.from_targets = Eigen::MatrixXd::Ones(1, 1);
    return;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(C, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Index rank = (svd.singularValues().array() > kLeastSingularValue).count();
  cluster.V = svd.matrixV();
  cluster.from_targets = svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
                         svd.matrixU().leftCols(rank).transpose();
}

}  // namespace

std::vector<HandleCluster> cluster_handles(const std::vector<BarycentricPoint>& points,
                                           Eigen::Index vertices) {
  const std::vector<int> number = number_clusters(points, vertices);
  std::vector<HandleCluster> result(number.empty() ? 0 : 1 + std::ranges::max(number));
  for (int i = 0; i < std::ssize(points); ++i) result[number[i]].points.push_back(i);
  std::vector<int> column(vertices, -1);
  for (HandleCluster& cluster : result) decompose(points, column, cluster);
  return result;
}

}  // namespace deformlab
