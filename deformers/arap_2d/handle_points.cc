#include "deformers/arap_2d/handle_points.h"

#include <Eigen/SVD>

#include "geometry/core/disjoint_sets.h"

namespace deformlab {
namespace {

constexpr double kSamePlace = 1e-6;  // singular values of C below it count as 0

// For each place the first of those that are connected with it by shared vertices.
std::vector<int> first_of_cluster(const std::vector<BarycentricPoint>& places,
                                  Eigen::Index vertices) {
  DisjointSets sets(std::ssize(places));
  std::vector<int> at_vertex(vertices, -1);
  for (int i = 0; i < std::ssize(places); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (places[i].b[c] == 0) continue;
      int& other = at_vertex[places[i].vertices[c]];
      if (other < 0) {
        other = i;
        continue;
      }
      sets.join(i, other);
    }
  }
  std::vector<int> first(places.size());
  for (int i = 0; i < std::ssize(places); ++i) first[i] = sets.root(i);
  return first;
}

void decompose(const std::vector<BarycentricPoint>& places, std::vector<int>& column,
               Cluster& cluster) {
  for (const int place : cluster.places) {
    for (int c = 0; c < 3; ++c) {
      const int v = places[place].vertices[c];
      if (places[place].b[c] == 0 || column[v] >= 0) continue;
      column[v] = static_cast<int>(cluster.vertices.size());
      cluster.vertices.push_back(v);
    }
  }
  Eigen::MatrixXd C =
      Eigen::MatrixXd::Zero(std::ssize(cluster.places), std::ssize(cluster.vertices));
  for (Eigen::Index row = 0; row < C.rows(); ++row) {
    const BarycentricPoint& place = places[cluster.places[row]];
    for (int c = 0; c < 3; ++c) {
      if (place.b[c] != 0) C(row, column[place.vertices[c]]) += place.b[c];
    }
  }
  if (C.size() == 1) {
    cluster.V = cluster.pull = Eigen::MatrixXd::Ones(1, 1);
    return;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(C, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Index rank = (svd.singularValues().array() > kSamePlace).count();
  cluster.V = svd.matrixV();
  cluster.pull = svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
                 svd.matrixU().leftCols(rank).transpose();
}

}  // namespace

std::vector<Cluster> clusters(const std::vector<BarycentricPoint>& places, Eigen::Index vertices) {
  const std::vector<int> first = first_of_cluster(places, vertices);
  std::vector<Cluster> result;
  std::vector<int> index(places.size()), column(vertices, -1);
  for (int i = 0; i < std::ssize(places); ++i) {
    if (first[i] == i) {
      index[i] = static_cast<int>(result.size());
      result.emplace_back();
    }
    result[index[first[i]]].places.push_back(i);
  }
  for (Cluster& cluster : result) decompose(places, column, cluster);
  return result;
}

}  // namespace deformlab
