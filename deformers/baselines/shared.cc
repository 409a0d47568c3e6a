#include "deformers/baselines/shared.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/deformation_graph.h"
#include "geometry/error.h"

namespace deformlab::baselines {

void check_handles(const Handles& handles, Eigen::Index vertices) {
  for (const auto* indices : {&handles.fixed, &handles.moved}) {
    for (const int i : *indices) {
      if (i >= 0 && i < vertices) continue;
      throw InputError("handle at vertex " + std::to_string(i) +
                       "; the shape has the vertices 0 to " + std::to_string(vertices - 1));
    }
  }
  std::vector<int> fixed = handles.fixed, moved = handles.moved, both;
  std::sort(fixed.begin(), fixed.end());
  std::sort(moved.begin(), moved.end());
  std::set_intersection(fixed.begin(), fixed.end(), moved.begin(), moved.end(),
                        std::back_inserter(both));
  if (both.empty()) return;
  throw InputError("vertex " + std::to_string(both.front()) + " is both fixed and moved");
}

void refuse_points(const Handles& handles, const std::string& method) {
  if (handles.points.cols() == 0) return;
  throw InputError(std::to_string(handles.points.cols()) +
                   " handles are no vertices of the shape, but " + method +
                   " holds a surface by its vertices; name the nearest vertices instead");
}

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

void check_targets(const Eigen::Matrix3Xd& targets, Eigen::Index count) {
  if (targets.cols() != count) {
    throw InputError(std::to_string(targets.cols()) + " targets for " + std::to_string(count) +
                     " handles; one for each is needed");
  }
  if (!targets.allFinite()) throw InputError("a handle's target is not finite");
}

void measure_handles(const Eigen::Matrix3Xd& reached, const Eigen::Matrix3Xd& targets,
                     Report& report) {
  if (targets.cols() == 0) return;
  const Eigen::VectorXd distance = (reached - targets).colwise().norm();
  report.handle_rms = std::sqrt(distance.squaredNorm() / static_cast<double>(targets.cols()));
  report.handle_max = distance.maxCoeff();
}

std::vector<int> components(int n, const std::vector<std::pair<int, int>>& links) {
  DeformationGraph graph;
  graph.g.resize(3, n);
  for (const auto& [a, b] : links) graph.edges.push_back({std::min(a, b), std::max(a, b), 1});
  return deformlab::components(graph);
}

}  // namespace deformlab::baselines
