#include <algorithm>
#include <sstream>

#include "geometry/error.h"
#include "geometry/overlap_triangles.h"
#include "geometry/triangulation.h"

namespace deformlab {
namespace {

[[noreturn]] void reject(const std::string& name, const std::string& what) {
  throw InputError("cannot use '" + name + "' as a flat mesh: " + what);
}

std::string named(int f, const Eigen::Vector3i& corners) {
  std::ostringstream text;
  text << "triangle " << f << " (vertices " << corners[0] << ", " << corners[1] << ", "
       << corners[2] << ")";
  return text.str();
}

void check_flat(const Shape& shape, const std::string& name) {
  const double low = shape.V.row(2).minCoeff(), high = shape.V.row(2).maxCoeff();
  if (low == high) return;
  std::ostringstream what;
  what << "z goes from " << low << " to " << high << "; it must be the same everywhere";
  reject(name, what.str());
}

void check_used(const Triangulation& mesh, const std::string& name) {
  std::vector<char> used(mesh.V.cols(), 0);
  for (const int v : mesh.F.reshaped()) used[v] = 1;
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused == used.end()) return;
  reject(name,
         "vertex " + std::to_string(unused - used.begin()) + " belongs to no triangle; remove it");
}

// The way all triangles turn.
int common_turn(const Triangulation& mesh, const std::string& name) {
  int first = 0;
  for (int f = 0; f < mesh.F.cols(); ++f) {
    const Eigen::Vector3i c = mesh.F.col(f);
    const int its = turn(mesh.V.col(c[0]), mesh.V.col(c[1]), mesh.V.col(c[2]));
    if (its == 0) reject(name, named(f, c) + " has no area; remove it");
    if (f == 0) first = its;
    if (its != first) {
      reject(name, named(f, c) + " turns the other way than triangle 0; make all turn one way");
    }
  }
  return first;
}

}  // namespace

Triangulation flat(const Shape& shape, const std::string& name) {
  check(shape, name);
  check_flat(shape, name);
  Triangulation mesh{shape.V.topRows<2>(), triangles(shape)};
  if (mesh.F.cols() == 0) reject(name, "it has no triangle; at least one is needed");
  check_used(mesh, name);
  if (common_turn(mesh, name) < 0) mesh.F.row(1).swap(mesh.F.row(2));
  return mesh;
}

}  // namespace deformlab
