#include "deformers/arap_2d/connectivity.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <utility>

#include "geometry/core/disjoint_sets.h"
#include "geometry/core/error.h"
#include "geometry/shape/shape.h"

namespace deformlab {
namespace {

constexpr double kMostContrast = 1e6;  // of weights: beyond it too few digits are left
constexpr double kHingeWeight = 1e-3;  // of the lesser weight of the two triangles

std::string named(int f, const Triangulation& mesh) {
  std::ostringstream text;
  text << "triangle " << f << " (vertices " << mesh.F(0, f) << ", " << mesh.F(1, f) << ", "
       << mesh.F(2, f) << ")";
  return text.str();
}

void check_vertices(const Triangulation& mesh) {
  for (Eigen::Index v = 0; v < mesh.V.cols(); ++v) {
    if (mesh.V.col(v).allFinite() && mesh.V.col(v).cwiseAbs().maxCoeff() <= kMostLength) continue;
    throw InputError(
        "vertex " + std::to_string(v) +
        " of the mesh is not finite, or beyond 1e50; coordinates are numbers within it");
  }
}

void check_triangle(int f, const Triangulation& mesh) {
  const Eigen::Vector3i corners = mesh.F.col(f);
  if (corners.minCoeff() < 0 || corners.maxCoeff() >= mesh.V.cols()) {
    throw InputError(named(f, mesh) +
                     " names a vertex that the mesh does not have; they are 0 to " +
                     std::to_string(mesh.V.cols() - 1));
  }
  for (int c = 0; c < 3; ++c) {
    const int i = corners[c], j = corners[(c + 1) % 3];
    if ((mesh.V.col(j) - mesh.V.col(i)).norm() >= kLeastLength) continue;
    throw InputError(named(f, mesh) + " has an edge of length 0, from vertex " + std::to_string(i) +
                     " to " + std::to_string(j) + "; merge the two vertices");
  }
}

void check_weights(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  if (weights.size() != mesh.F.cols()) {
    throw InputError(std::to_string(weights.size()) + " weights for " +
                     std::to_string(mesh.F.cols()) + " triangles; one for each is needed");
  }
  for (Eigen::Index f = 0; f < weights.size(); ++f) {
    const double most = weights.maxCoeff();
    if (weights[f] > 0 && std::isfinite(most) && weights[f] * kMostContrast >= most) continue;
    std::ostringstream text;
    text << "the weight of triangle " << f << " is " << weights[f]
         << "; weights are positive numbers, the largest at most 1e6 times the least";
    throw InputError(text.str());
  }
}

// Triangles that hang together by edges share a root.
DisjointSets bodies(const Triangulation& mesh) {
  DisjointSets sets(mesh.F.cols());
  std::map<std::pair<int, int>, int> at_edge;
  for (int f = 0; f < mesh.F.cols(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const auto edge = std::minmax({mesh.F(c, f), mesh.F((c + 1) % 3, f)});
      sets.join(f, at_edge.try_emplace(edge, f).first->second);
    }
  }
  return sets;
}

// The two corners of a triangle besides v.
std::array<int, 2> others(const Eigen::Vector3i& corners, int v) {
  const int c = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
  return {corners[(c + 1) % 3], corners[(c + 2) % 3]};
}

// Between two triangles that share v alone, with the longest third edge there is.
Eigen::Vector3i hinge(const Triangulation& mesh, int v, int f, int g) {
  Eigen::Vector3i best;
  double longest = -1;
  for (const int a : others(mesh.F.col(f), v)) {
    for (const int b : others(mesh.F.col(g), v)) {
      const double length = (mesh.V.col(a) - mesh.V.col(b)).norm();
      if (length <= longest) continue;
      longest = length;
      best << v, a, b;
    }
  }
  return best;
}

}  // namespace

void check(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  if (mesh.F.cols() == 0) throw InputError("the mesh has no triangle; at least one is needed");
  check_vertices(mesh);
  std::vector<char> used(mesh.V.cols(), 0);
  for (int f = 0; f < mesh.F.cols(); ++f) {
    check_triangle(f, mesh);
    for (const int v : mesh.F.col(f)) used[v] = 1;
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    throw InputError("vertex " + std::to_string(unused - used.begin()) +
                     " belongs to no triangle; remove it");
  }
  check_weights(mesh, weights);
}

std::vector<MeshComponent> components(const Triangulation& mesh) {
  DisjointSets sets(mesh.V.cols());
  for (const auto corners : mesh.F.colwise()) {
    sets.join(corners[0], corners[1]);
    sets.join(corners[0], corners[2]);
  }
  std::vector<int> index(mesh.V.cols());
  std::vector<MeshComponent> result;
  for (int v = 0; v < mesh.V.cols(); ++v) {
    const int root = sets.root(v);
    if (root == v) {
      index[v] = static_cast<int>(result.size());
      result.emplace_back();
    }
    result[index[root]].vertices.push_back(v);
  }
  for (int f = 0; f < mesh.F.cols(); ++f) {
    result[index[sets.root(mesh.F(0, f))]].triangles.push_back(f);
  }
  return result;
}

Hinges hinges(const Triangulation& mesh, const Eigen::VectorXd& weights) {
  DisjointSets sets = bodies(mesh);
  std::vector<int> at_vertex(mesh.V.cols(), -1);
  std::vector<Eigen::Vector3i> F;
  std::vector<double> w;
  for (int f = 0; f < mesh.F.cols(); ++f) {
    for (const int v : mesh.F.col(f)) {
      const int g = std::exchange(at_vertex[v], f);
      if (g < 0 || !sets.join(f, g)) continue;
      F.push_back(hinge(mesh, v, f, g));
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
