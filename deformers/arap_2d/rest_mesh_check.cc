#include "deformers/arap_2d/rest_mesh_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/core/error.h"
#include "geometry/shape/shape.h"

namespace deformlab {
namespace {

// The greatest allowed ratio of two weights. Greater ones would leave too few correct digits.
constexpr double kMostContrast = 1e6;

std::string name_of(int f, const Triangulation& mesh) {
  return fmt::format("triangle {} (vertices {}, {}, {})", f, mesh.F(0, f), mesh.F(1, f),
                     mesh.F(2, f));
}

void check_vertices(const Triangulation& mesh) {
  for (Eigen::Index v = 0; v < mesh.V.cols(); ++v) {
    if (mesh.V.col(v).cwiseAbs().maxCoeff() <= kMostLength) continue;
    throw InputError(
        fmt::format("vertex {} of the mesh is at ({}, {}); coordinates are finite numbers from "
                    "-1e50 to 1e50",
                    v, mesh.V(0, v), mesh.V(1, v)));
  }
}

void check_triangle(int f, const Triangulation& mesh) {
  const Eigen::Vector3i corners = mesh.F.col(f);
  for (int c = 0; c < 3; ++c) {
    const int i = corners[c], j = corners[(c + 1) % 3];
    if ((mesh.V.col(j) - mesh.V.col(i)).norm() >= kLeastLength) continue;
    throw InputError(
        fmt::format("{} has an edge of length 0, from vertex {} to {}; merge the two vertices",
                    name_of(f, mesh), i, j));
  }
}

void check_every_vertex_is_used(const Triangulation& mesh) {
  std::vector<char> used(mesh.V.cols(), 0);
  for (const int v : mesh.F.reshaped()) used[v] = 1;
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused == used.end()) return;
  throw InputError(
      fmt::format("vertex {} belongs to no triangle; remove it", unused - used.begin()));
}

void check_weights(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  if (weights.size() != mesh.F.cols()) {
    throw InputError(fmt::format("{} weights for {} triangles; one for each is needed",
                                 weights.size(), mesh.F.cols()));
  }
  const double most = weights.maxCoeff();
  for (Eigen::Index f = 0; f < weights.size(); ++f) {
    if (weights[f] > 0 && std::isfinite(most) && weights[f] * kMostContrast >= most) continue;
    throw InputError(
        fmt::format("the weight of triangle {} is {}; weights are positive numbers, the largest at "
                    "most 1e6 times the least",
                    f, weights[f]));
  }
}

}  // namespace

void check_rest_mesh(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  if (mesh.F.cols() == 0) throw InputError("the mesh has no triangle; at least one is needed");
  check(mesh);
  check_vertices(mesh);
  for (int f = 0; f < mesh.F.cols(); ++f) check_triangle(f, mesh);
  check_every_vertex_is_used(mesh);
  check_weights(mesh, weights);
}

}  // namespace deformlab
