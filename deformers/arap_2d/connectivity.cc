#include "deformers/arap_2d/connectivity.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "geometry/core/disjoint_sets.h"

namespace deformlab {
namespace {

constexpr double kHingeWeight = 1e-3;  // relative to the lesser weight of the two triangles

// Triangles that are connected by shared edges have the same root. Edges are sorted by their lower
// vertices, and those of one lower vertex are found by their upper ones.
DisjointSets sets_by_shared_edges(const Triangulation& mesh) {
  std::vector<int> begin(mesh.V.cols() + 2, 0);
  const auto for_each_edge = [&](auto&& visit) {
    for (int f = 0; f < mesh.F.cols(); ++f) {
      for (int c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax({mesh.F(c, f), mesh.F((c + 1) % 3, f)});
        visit(low, high, f);
      }
    }
  };
  for_each_edge([&](int low, int, int) { ++begin[low + 2]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::pair<int, int>> edges(begin.back());  // upper vertices and triangles
  for_each_edge([&](int low, int high, int f) { edges[begin[low + 1]++] = {high, f}; });
  DisjointSets sets(mesh.F.cols());
  std::vector<std::pair<int, int>> first(mesh.V.cols(), {-1, 0});  // a lower vertex, and a triangle
  for (int low = 0; low < mesh.V.cols(); ++low) {
    for (int e = begin[low]; e < begin[low + 1]; ++e) {
      const auto [high, f] = edges[e];
      if (first[high].first != low) first[high] = {low, f};
      sets.join(f, first[high].second);
    }
  }
  return sets;
}

std::array<int, 2> corners_besides(int v, const Eigen::Vector3i& corners) {
  const int c = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
  return {corners[(c + 1) % 3], corners[(c + 2) % 3]};
}

// The triangle of v and one more corner of each of f and g, which share only v. Of the four choices
// it is the one with the longest edge opposite to v.
Eigen::Vector3i hinge_between(int f, int g, int v, const Triangulation& mesh) {
  Eigen::Vector3i best;
  double longest = -1;
  for (const int a : corners_besides(v, mesh.F.col(f))) {
    for (const int b : corners_besides(v, mesh.F.col(g))) {
      const double length = (mesh.V.col(a) - mesh.V.col(b)).norm();
      if (length <= longest) continue;
      longest = length;
      best << v, a, b;
    }
  }
  return best;
}

}  // namespace

bool MeshComponent::contains(int vertex) const {
  return std::binary_search(vertices.begin(), vertices.end(), vertex);
}

std::vector<MeshComponent> components(const Triangulation& mesh) {
  DisjointSets sets(mesh.V.cols());
  sets.join_corners(mesh.F);
  const std::vector<int> number = sets.numbered();
  std::vector<MeshComponent> result(number.empty() ? 0 : 1 + std::ranges::max(number));
  for (int v = 0; v < mesh.V.cols(); ++v) result[number[v]].vertices.push_back(v);
  for (int f = 0; f < mesh.F.cols(); ++f) result[number[mesh.F(0, f)]].triangles.push_back(f);
  return result;
}

std::vector<int> points_inside(const MeshComponent& component,
                               const std::vector<BarycentricPoint>& points) {
  std::vector<int> result;
  for (int i = 0; i < std::ssize(points); ++i) {
    if (component.contains(points[i].vertices[0])) result.push_back(i);
  }
  return result;
}

Hinges hinges(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  DisjointSets sets = sets_by_shared_edges(mesh);
  std::vector<int> at_vertex(mesh.V.cols(), -1);  // the last triangle so far at each vertex
  std::vector<Eigen::Vector3i> F;
  std::vector<double> w;
  for (int f = 0; f < mesh.F.cols(); ++f) {
    for (const int v : mesh.F.col(f)) {
      const int g = std::exchange(at_vertex[v], f);
      if (g < 0 || !sets.join(f, g)) continue;
      F.push_back(hinge_between(f, g, v, mesh));
      w.push_back(kHingeWeight * std::min(weights[f], weights[g]));
    }
  }
  Hinges result{Eigen::Matrix3Xi(3, std::ssize(F)), Eigen::VectorXd(std::ssize(w))};
  for (int h = 0; h < std::ssize(F); ++h) {
    result.F.col(h) = F[h];
    result.weights[h] = w[h];
  }
  return result;
}

}  // namespace deformlab
