#include "geometry/graph/placement/graph_simplification.h"

#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/core/options.h"
#include "geometry/graph/graph_mesh.h"

namespace deformlab {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Point = MeshKernel::Point_3;
using Profile = sms::Edge_profile<Mesh>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastCosine = 0.2;  // between a triangle's normals before and after: 78 degrees

Eigen::Vector3d vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

bool is_on_border(const Mesh& mesh, Mesh::Vertex_index v) { return mesh.is_border(v, true); }

// The end into which an edge may collapse, if there is one.
class EndPlacement {
 public:
  explicit EndPlacement(double max_aspect_ratio) : max_(max_aspect_ratio) {}

  boost::optional<Point> operator()(const Profile& edge) const {
    const Mesh& mesh = edge.surface_mesh();
    const bool keep0 = is_on_border(mesh, edge.v0()), keep1 = is_on_border(mesh, edge.v1());
    // A border vertex that leaves the border would make the surface smaller.
    const double worst0 = keep1 && !keep0 ? kInfinity : worst_after(edge, edge.v1(), edge.v0());
    const double worst1 = keep0 && !keep1 ? kInfinity : worst_after(edge, edge.v0(), edge.v1());
    if (std::min(worst0, worst1) == kInfinity) return {};
    return worst0 <= worst1 ? edge.p0() : edge.p1();
  }

 private:
  // The greatest aspect ratio among the triangles that change when `from` moves to `to`, or
  // infinity where that is not allowed.
  double worst_after(const Profile& edge, Mesh::Vertex_index from, Mesh::Vertex_index to) const {
    const auto& star = edge.triangles();  // begins with the triangles that vanish
    const std::size_t vanishing = edge.left_face_exists() + edge.right_face_exists();
    double before = max_, after = 1;
    for (std::size_t t = vanishing; t < star.size(); ++t) {
      if (star[t].v1 != from) continue;  // v1 is the corner that moves
      const Mesh& mesh = edge.surface_mesh();
      const Eigen::Vector3d a = vector(mesh.point(star[t].v0)), c = vector(mesh.point(star[t].v2));
      const Eigen::Vector3d p = vector(mesh.point(from)), q = vector(mesh.point(to));
      const Eigen::Vector3d n = (a - p).cross(c - p), n_after = (a - q).cross(c - q);
      if (n.dot(n_after) < kLeastCosine * n.norm() * n_after.norm()) return kInfinity;
      before = std::max(before, aspect_ratio(a, p, c));
      after = std::max(after, aspect_ratio(a, q, c));
    }
    return after <= before ? after : kInfinity;
  }

  double max_;
};

struct StopAtVertices {
  std::size_t count;
  bool operator()(double, const Profile& edge, std::size_t, std::size_t) const {
    return edge.surface_mesh().number_of_vertices() <= count;
  }
};

// Keeps, for each vertex of the mesh, the vertex of the shape at whose position it is.
struct Origins : sms::Edge_collapse_visitor_base<Mesh> {
  explicit Origins(std::vector<int>& of_each) : origin(&of_each) {}

  void OnCollapsing(const Profile& edge, const boost::optional<Point>& place) {
    if (place) kept = (*origin)[*place == edge.p0() ? edge.v0() : edge.v1()];
  }
  void OnCollapsed(const Profile&, Mesh::Vertex_index v) {
    if (kept) (*origin)[v] = *kept;  // otherwise the edge has no length, and its ends are alike
    kept.reset();
  }

  std::vector<int>* origin;
  std::optional<int> kept;
};

void check(int m, double max_aspect_ratio, std::size_t vertices) {
  check_number("aspect_ratio", max_aspect_ratio, {.min = 1});
  if (m >= 1 && static_cast<std::size_t>(m) <= vertices) return;
  throw OptionError(
      "nodes", std::to_string(m),
      fmt::format("; the mesh can be simplified to 1 to {} of its vertices", vertices));
}

[[noreturn]] void reject_count(int m, std::size_t reached, double max_aspect_ratio) {
  throw OptionError(
      "nodes", std::to_string(m),
      fmt::format(
          ", but simplification ends at {0}: beyond that, triangles would turn over, get an "
          "aspect ratio above {1}, or parts of the mesh would vanish; use {0} nodes, a "
          "greater aspect_ratio, or method: sampling",
          reached, max_aspect_ratio));
}

Simplified result_of(const Mesh& mesh, const std::vector<int>& origin) {
  Simplified result;
  for (const auto v : mesh.vertices()) result.vertices.push_back(origin[v]);
  std::sort(result.vertices.begin(), result.vertices.end());
  result.T.resize(3, static_cast<Eigen::Index>(mesh.number_of_faces()));
  Eigen::Index t = 0;
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      result.T(corner++, t) = origin[v];
    }
    ++t;
  }
  return result;
}

}  // namespace

double aspect_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double x = (b - c).norm(), y = (c - a).norm(), z = (a - b).norm();
  const double twice_area = (b - a).cross(c - a).norm();
  const double ratio = x * y * z * (x + y + z) / (4 * twice_area * twice_area);
  return std::isfinite(ratio) ? ratio : kInfinity;
}

Simplified simplify(const Shape& shape, int m, double max_aspect_ratio) {
  MeshPart part = manifold_mesh(shape, triangles(shape), "method: simplification");
  check(m, max_aspect_ratio, part.vertices.size());
  std::vector<int>& origin = part.vertices;
  sms::edge_collapse(part.mesh, StopAtVertices{static_cast<std::size_t>(m)},
                     CGAL::parameters::get_cost(sms::Edge_length_cost<Mesh>())
                         .get_placement(EndPlacement(max_aspect_ratio))
                         .visitor(Origins(origin)));
  const std::size_t reached = part.mesh.number_of_vertices();
  if (reached != static_cast<std::size_t>(m)) reject_count(m, reached, max_aspect_ratio);
  return result_of(part.mesh, origin);
}

}  // namespace deformlab
