#include "deformers/baselines/shared.h"

#include <algorithm>

#include "geometry/core/error.h"
#include "geometry/graph/deformation_graph.h"

namespace deformlab::baselines {
namespace {

Eigen::Matrix3Xi proper_triangles(const Shape& shape, const std::string& method) {
  const Eigen::Matrix3Xi all = triangles(shape);
  std::vector<int> proper;
  for (int t = 0; t < all.cols(); ++t) {
    const auto corners = all.col(t);
    const bool repeats =
        corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
    if (!repeats) proper.push_back(t);
  }
  if (!proper.empty()) return all(Eigen::all, proper);
  throw InputError("the shape has no triangles (it is a set of points), and " + method +
                   " deforms surfaces; give a mesh, or use embedded deformation");
}

}  // namespace

void refuse_points(const Handles& handles, const std::string& method) {
  if (handles.points.cols() == 0) return;
  throw InputError(std::to_string(handles.points.cols()) +
                   " handles are no vertices of the shape, but " + method +
                   " holds a surface by its vertices; name the nearest vertices instead");
}

Surface surface_of(const Shape& shape, const std::string& method) {
  check(shape, "the shape");
  Surface surface{proper_triangles(shape, method), {}, {}};
  std::vector<char> used(shape.V.cols(), 0);
  for (const int v : surface.T.reshaped()) used[v] = 1;
  for (int v = 0; v < std::ssize(used); ++v) {
    if (used[v]) surface.vertices.push_back(v);
  }
  if (const auto loose = std::ssize(used) - std::ssize(surface.vertices); loose > 0) {
    surface.notes.push_back("vertices in no triangle, which move only where they are handles: " +
                            std::to_string(loose));
  }
  return surface;
}

std::vector<int> components(int n, const std::vector<std::pair<int, int>>& links) {
  DeformationGraph graph;
  graph.g.resize(3, n);
  for (const auto& [a, b] : links) graph.edges.push_back({std::min(a, b), std::max(a, b), 1});
  return deformlab::components(graph);
}

}  // namespace deformlab::baselines
