#define CGAL_EIGEN3_ENABLED  // the heat method factors with Eigen
#include "geometry/transfer/geodesic.h"

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "geometry/core/disjoint_sets.h"
#include "geometry/core/indices.h"
#include "geometry/core/options.h"
#include "geometry/graph/graph_mesh.h"

namespace deformlab {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kWish = "distance: geodesic";

[[noreturn]] void reject_thin_triangles() {
  throw OptionError("distance", "geodesic",
                    ", which cannot be measured on this mesh: it has triangles of no area; repair "
                    "them, or take distance: edge_paths");
}

// The triangles of each connected part.
std::vector<Eigen::Matrix3Xi> triangles_by_part(const Shape& shape, const std::vector<int>& part) {
  const Eigen::Matrix3Xi T = triangles(shape);
  std::vector<std::vector<Eigen::Index>> columns(shape.V.cols());
  for (Eigen::Index t = 0; t < T.cols(); ++t) columns[part[T(0, t)]].push_back(t);
  std::vector<Eigen::Matrix3Xi> result;
  for (const auto& of_part : columns) result.emplace_back(T(Eigen::all, of_part));
  return result;
}

// The heat method on one connected part, whose matrices are factored once.
class HeatMethod {
 public:
  // CGAL also offers the method on intrinsic Delaunay triangulations. It is not used, because it
  // flips edges for ever where many points lie on one circle, as on the lid of a can.
  using Solver = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<Mesh>;

  HeatMethod(const Shape& shape, const Eigen::Matrix3Xi& T)
      : part_(manifold_mesh(shape, T, kWish)),
        solver_(part_.mesh),
        d_(part_.mesh.add_property_map<Mesh::Vertex_index, double>("distance").first) {}

  // Writes the distances of all vertices of the part from one of them.
  void measure(const Shape& shape, int source, Eigen::VectorXd& d) {
    const auto at = std::lower_bound(part_.vertices.begin(), part_.vertices.end(), source);
    solver_.clear_sources();
    solver_.add_source(Mesh::Vertex_index(static_cast<unsigned>(at - part_.vertices.begin())));
    solver_.estimate_geodesic_distances(d_);
    for (const auto v : part_.mesh.vertices()) {
      if (!std::isfinite(d_[v])) reject_thin_triangles();
      const int i = part_.vertices[v];
      d[i] = std::max(d_[v], (shape.V.col(i) - shape.V.col(source)).norm());
    }
  }

  void forget(Eigen::VectorXd& d) const { d(part_.vertices).setConstant(kInfinity); }

 private:
  MeshPart part_;  // must not move, because the solver refers to it
  Solver solver_;
  Mesh::Property_map<Mesh::Vertex_index, double> d_;
};

std::unique_ptr<HeatMethod> make_heat_method(const Shape& shape, const Eigen::Matrix3Xi& T) {
  for (const auto t : T.colwise()) {
    const Eigen::Vector3d u = shape.V.col(t[1]) - shape.V.col(t[0]);
    if (u.cross(Eigen::Vector3d(shape.V.col(t[2]) - shape.V.col(t[0]))).norm() == 0) {
      reject_thin_triangles();  // CGAL would fail in an assertion
    }
  }
  try {
    return std::make_unique<HeatMethod>(shape, T);
  } catch (const CGAL::Failure_exception&) {  // a factorization failed
    reject_thin_triangles();
  }
}

// The distance of a source that is among a vertex's nearest ones, or infinity.
double distance_of(const NearestSources& nearest, Eigen::Index vertex, int source) {
  for (int a = 0; a < nearest.found[vertex]; ++a) {
    if (nearest.sources(a, vertex) == source) return nearest.distances(a, vertex);
  }
  return kInfinity;
}

}  // namespace

std::vector<int> connected_parts(const Shape& shape) {
  DisjointSets sets(shape.V.cols());
  sets.join_corners(triangles(shape));
  return sets.numbered();
}

NearestSources::NearestSources(int count, Eigen::Index vertices)
    : sources(Eigen::MatrixXi::Zero(count, vertices)),
      distances(Eigen::MatrixXd::Constant(count, vertices, kInfinity)),
      found(Eigen::VectorXi::Zero(vertices)) {}

void NearestSources::insert(Eigen::Index vertex, int source, double distance) {
  int at = found[vertex];
  const int count = static_cast<int>(distances.rows());
  while (at > 0 && distances(at - 1, vertex) > distance) --at;
  if (at == count) return;
  found[vertex] = std::min(found[vertex] + 1, count);
  for (int a = found[vertex] - 1; a > at; --a) {
    distances(a, vertex) = distances(a - 1, vertex);
    sources(a, vertex) = sources(a - 1, vertex);
  }
  distances(at, vertex) = distance;
  sources(at, vertex) = source;
}

void heat_distances(const Shape& shape, std::span<const int> sources,
                    const std::function<void(int s, const Eigen::VectorXd& d)>& visit) {
  check_indices(sources, shape.V.cols(), "vertex", "the sources");
  const std::vector<int> part = connected_parts(shape);
  const std::vector<Eigen::Matrix3Xi> T = triangles_by_part(shape, part);
  if (triangles(shape).cols() == 0) manifold_mesh(shape, {}, kWish);  // throws
  std::vector<std::unique_ptr<HeatMethod>> methods(T.size());
  Eigen::VectorXd d = Eigen::VectorXd::Constant(shape.V.cols(), kInfinity);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const int source = sources[s], p = part[source];
    if (T[p].cols() == 0) {  // a vertex without a face
      d[source] = 0;
      visit(static_cast<int>(s), d);
      d[source] = kInfinity;
      continue;
    }
    if (!methods[p]) methods[p] = make_heat_method(shape, T[p]);
    methods[p]->measure(shape, source, d);
    visit(static_cast<int>(s), d);
    methods[p]->forget(d);
  }
}

NearestSources nearest_along_surface(const Shape& shape, std::span<const int> sources, int count) {
  const NearestSources paths = nearest_along_edges(shape, sources, 2 * count);
  NearestSources nearest(count, shape.V.cols());
  heat_distances(shape, sources, [&](int s, const Eigen::VectorXd& d) {
    for (Eigen::Index i = 0; i < d.size(); ++i) {
      if (std::isinf(d[i])) continue;
      nearest.insert(i, s, std::min(d[i], distance_of(paths, i, s)));
    }
  });
  return nearest;
}

}  // namespace deformlab
