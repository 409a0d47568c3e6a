#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/plane/overlap/overlap_triangles.h"
#include "geometry/plane/triangulation.h"
#include "geometry/shape/usable.h"

namespace deformlab {
namespace {

constexpr double kFlat = 1e-6;  // allowed extent along z as a share; a file's digits are rounded

void check_flat(const Shape& shape, const std::string& name) {
  const double z = shape.V.row(2).maxCoeff() - shape.V.row(2).minCoeff();
  if (z <= kFlat * bounding_box_diagonal(shape.V)) return;
  cannot_use(name,
             fmt::format("it is not flat: z goes from {:g} to {:g}; all vertices need the same z",
                         shape.V.row(2).minCoeff(), shape.V.row(2).maxCoeff()));
}

void check_used(const Triangulation& mesh, const std::string& name) {
  std::vector<bool> used(mesh.V.cols(), false);
  for (const int v : mesh.F.reshaped()) used[v] = true;
  const auto unused = std::ranges::find(used, false);
  if (unused == used.end()) return;
  cannot_use(name,
             fmt::format("vertex {} (counted from 0) is the corner of no triangle; leave it out",
                         unused - used.begin()));
}

std::string described(const Triangulation& mesh, Eigen::Index t) {
  return fmt::format("the triangle of vertices {} (counted from 0)", fmt::join(mesh.F.col(t), " "));
}

// The sign of the orientation that all triangles have.
int common_turn(const Triangulation& mesh, const std::string& name) {
  int first = 0;
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) {
    const TriangleCorners c = mesh.V(Eigen::all, mesh.F.col(t));
    const int here = turn(c.col(0), c.col(1), c.col(2));
    if (here == 0)
      cannot_use(name, fmt::format("{} has no area; leave it out", described(mesh, t)));
    if (first == 0) first = here;
    if (here != first) {
      cannot_use(name,
                 fmt::format("{} turns the other way than the first; all of them have to turn "
                             "alike: unfold the mesh, or swap two of its corners",
                             described(mesh, t)));
    }
  }
  return first;
}

}  // namespace

Triangulation flat(const Shape& shape, const std::string& name) {
  check(shape, name);
  check_flat(shape, name);
  Triangulation mesh{shape.V.topRows<2>(), triangles(shape)};
  if (mesh.F.cols() == 0) cannot_use(name, "it has no triangle; a drawing's mesh needs faces");
  check_used(mesh, name);
  if (common_turn(mesh, name) < 0) mesh.F.row(1).swap(mesh.F.row(2));
  return mesh;
}

}  // namespace deformlab
