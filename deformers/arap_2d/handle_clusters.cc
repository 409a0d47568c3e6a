#include "deformers/arap_2d/handle_clusters.h"

#include <Eigen/SVD>
#include <algorithm>
#include <map>

#include "geometry/core/disjoint_sets.h"

namespace deformlab {
namespace {

constexpr double kLeastSingularValue = 1e-6;  // smaller singular values of C count as 0

// The number of each point's cluster. Points that share vertices are in the same cluster.
std::vector<int> number_clusters(const std::vector<BarycentricPoint>& points) {
  DisjointSets sets(std::ssize(points));
  std::map<int, int> at_vertex;  // the first point that has each vertex
  for (int i = 0; i < std::ssize(points); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (points[i].b[c] == 0) continue;
      sets.join(i, at_vertex.try_emplace(points[i].vertices[c], i).first->second);
    }
  }
  return sets.numbered();
}

void decompose(const std::vector<BarycentricPoint>& points, HandleCluster& cluster) {
  std::map<int, int> column;  // of C, for each vertex
  for (const int i : cluster.points) {
    for (int c = 0; c < 3; ++c) {
      const int v = points[i].vertices[c], next = static_cast<int>(cluster.vertices.size());
      if (points[i].b[c] == 0 || !column.try_emplace(v, next).second) continue;
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

std::vector<HandleCluster> cluster_handles(const std::vector<BarycentricPoint>& points) {
  const std::vector<int> number = number_clusters(points);
  std::vector<HandleCluster> result(number.empty() ? 0 : 1 + std::ranges::max(number));
  for (int i = 0; i < std::ssize(points); ++i) result[number[i]].points.push_back(i);
  for (HandleCluster& cluster : result) decompose(points, cluster);
  return result;
}

}  // namespace deformlab
