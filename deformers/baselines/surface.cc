#include "deformers/baselines/surface.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/core/error.h"

namespace deformlab::baselines {
namespace {

// The triangles without those that name a vertex twice.
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
  throw InputError(
      fmt::format("the shape has no triangles (it is a set of points), and {} deforms surfaces; "
                  "give a mesh, or use embedded deformation",
                  method));
}

}  // namespace

Surface surface_of(const Shape& shape, const std::string& method) {
  check(shape, "the shape");
  Surface surface{proper_triangles(shape, method), {}, {}};
  std::vector<char> used(shape.V.cols(), 0);
  for (const int v : surface.T.reshaped()) used[v] = 1;
  for (int v = 0; v < std::ssize(used); ++v) {
    if (used[v]) surface.vertices.push_back(v);
  }
  if (const auto loose = std::ssize(used) - std::ssize(surface.vertices); loose > 0) {
    surface.notes.push_back(
        fmt::format("vertices in no triangle, which move only where they are handles: {}", loose));
  }
  return surface;
}

void refuse_points(const Handles& handles, const std::string& method) {
  if (handles.points.cols() == 0) return;
  throw InputError(
      fmt::format("{} handles are no vertices of the shape, but {} takes vertices as handles only; "
                  "name the nearest vertices instead",
                  handles.points.cols(), method));
}

std::string note_on_free_components(int count) {
  return fmt::format("parts of the surface without a handle, which stay where they are: {}", count);
}

bool is_thin(const Eigen::Matrix3d& corners, double least) {
  const Eigen::Vector3d a = corners.col(1) - corners.col(0), b = corners.col(2) - corners.col(0);
  const double longest2 = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
  return a.cross(b).norm() <= least * longest2;
}

}  // namespace deformlab::baselines
