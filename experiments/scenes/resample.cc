#include "experiments/scenes/resample.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/subdivision_method_3.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "geometry/core/options.h"

namespace deformlab {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;
namespace sms = CGAL::Surface_mesh_simplification;

constexpr int kMostVertices = 2'000'000;

Mesh mesh_of(const Shape& shape) {
  std::vector<Kernel::Point_3> points;
  for (const auto v : shape.V.colwise()) points.emplace_back(v.x(), v.y(), v.z());
  std::vector<std::vector<int>> polygons;
  const Eigen::Matrix3Xi T = triangles(shape);
  for (const auto t : T.colwise()) polygons.push_back({t[0], t[1], t[2]});
  if (polygons.empty() || !pmp::is_polygon_soup_a_polygon_mesh(polygons)) {
    throw InputError(
        "shape.vertices asks for another number of vertices, but the shape is no manifold mesh; "
        "leave it out");
  }
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return mesh;
}

Shape shape_of(Mesh& mesh) {
  mesh.collect_garbage();
  Shape shape;
  shape.V.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  shape.N.resize(3, 0);
  for (const auto v : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(v);
    shape.V.col(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  for (const auto f : mesh.faces()) {
    std::vector<int>& face = shape.faces.emplace_back();
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      face.push_back(static_cast<int>(v.idx()));
    }
  }
  return shape;
}

// CGAL's stop conditions count edges. They cannot stop at a number of vertices, because a collapse
// removes three edges, or two at a boundary.
struct StopAtVertices {
  std::size_t wanted;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_vertices() <= wanted;
  }
};

}  // namespace

Shape resampled(const Shape& shape, int vertices) {
  if (vertices < 4 || vertices > kMostVertices) {
    throw OptionError("shape.vertices", std::to_string(vertices),
                      fmt::format("; allowed: 4 to {}, or 0 for those of the file", kMostVertices));
  }
  Mesh mesh = mesh_of(shape);
  while (static_cast<int>(mesh.number_of_vertices()) < vertices) {
    CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
  }
  sms::edge_collapse(mesh, StopAtVertices{static_cast<std::size_t>(vertices)});
  Shape result = shape_of(mesh);
  if (std::abs(result.V.cols() - vertices) > 0.01 * vertices) {
    throw OptionError(
        "shape.vertices", std::to_string(vertices),
        fmt::format(", but the shape comes to {} only; ask for more", result.V.cols()));
  }
  return result;
}

}  // namespace deformlab
