#include "geometry/graph/graph_mesh.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <algorithm>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

// The vertices of the triangles in ascending order, each once.
std::vector<int> used_vertices(const Eigen::Matrix3Xi& T) {
  std::vector<int> used(T.data(), T.data() + T.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

}  // namespace

MeshPart manifold_mesh(const Shape& shape, const Eigen::Matrix3Xi& T, const std::string& wish) {
  if (T.cols() == 0) throw InputError(wish + " needs a mesh, but the shape has no faces");
  MeshPart part;
  part.vertices = used_vertices(T);
  std::vector<int> index(static_cast<std::size_t>(shape.V.cols()), -1);
  std::vector<MeshKernel::Point_3> points;
  for (const int v : part.vertices) {
    index[v] = static_cast<int>(points.size());
    points.emplace_back(shape.V(0, v), shape.V(1, v), shape.V(2, v));
  }
  std::vector<std::vector<int>> polygons;
  for (const auto t : T.colwise()) polygons.push_back({index[t[0]], index[t[1]], index[t[2]]});
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) {
    throw InputError(wish +
                     " needs a manifold mesh, but the shape has an edge of more than two faces, "
                     "neighbours that face opposite ways, parts that only touch in a vertex, or a "
                     "face that names a vertex twice; repair it");
  }
  pmp::polygon_soup_to_polygon_mesh(points, polygons, part.mesh);
  return part;
}

}  // namespace deformlab
