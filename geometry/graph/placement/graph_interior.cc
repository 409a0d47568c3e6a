#include "geometry/graph/placement/graph_interior.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "geometry/shape/weld.h"

namespace deformlab {
namespace {

constexpr double kReach = 1.7;       // of an edge, in spacings
constexpr double kLeastGap = 0.5;    // between a node inside and one on the surface, in spacings
constexpr double kOnSurface = 0.01;  // of an edge: this end of it touches the surface
constexpr double kMostCells = 2e5;   // of the grid
constexpr double kMostPerNode = 3;   // nodes inside for each on the surface

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Side = std::pair<int, int>;

Kernel::Point_3 point(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

// The triangles of a surface that have three different corners.
std::vector<std::array<int, 3>> proper_triangles(const Shape& shape) {
  const Eigen::Matrix3Xi T = WeldedSurface(shape).welded_triangles();
  std::vector<std::array<int, 3>> result;
  for (const auto t : T.colwise()) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.push_back({t[0], t[1], t[2]});
  }
  return result;
}

// The surface, for exact questions about where it is.
class Surface {
 public:
  explicit Surface(const Shape& shape) {
    for (const auto& t : proper_triangles(shape)) {
      const Kernel::Triangle_3 triangle(point(shape.V.col(t[0])), point(shape.V.col(t[1])),
                                        point(shape.V.col(t[2])));
      if (!triangle.is_degenerate()) triangles_.push_back(triangle);
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  // A ray that meets an edge would count two triangles. Such a ray is rare, because no direction is
  // one that shapes have, and two other rays outvote it.
  bool contains(const Eigen::Vector3d& p) const {
    int inside = 0;
    for (const auto& direction : {Kernel::Vector_3(0.6180339, 0.3819660, 0.6871215),
                                  Kernel::Vector_3(-0.4142135, 0.7320508, 0.5403023),
                                  Kernel::Vector_3(0.2360679, -0.6457513, -0.7261543)}) {
      inside += tree_.number_of_intersected_primitives(Kernel::Ray_3(point(p), direction)) % 2;
    }
    return inside >= 2;
  }
  bool meets(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    return tree_.do_intersect(Kernel::Segment_3(point(a), point(b)));
  }

 private:
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

  Triangles triangles_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

using Tree =
    nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2_Simple, false>;

double mean_gap(const Eigen::Matrix3Xd& g) {
  const Tree tree(3, g);
  double sum = 0;
  for (const auto p : g.colwise()) {
    std::array<Eigen::Index, 2> nearest{};
    std::array<double, 2> squares{};
    tree.query(p.data(), 2, nearest.data(), squares.data());
    sum += std::sqrt(squares[1]);
  }
  return sum / static_cast<double>(g.cols());
}

std::vector<int> within(const Tree& tree, const Eigen::Vector3d& p, double reach) {
  std::vector<std::pair<Eigen::Index, double>> found;
  tree.index->radiusSearch(p.data(), reach * reach, found, {});
  std::vector<int> result;
  for (const auto& [index, square] : found) result.push_back(static_cast<int>(index));
  std::ranges::sort(result);
  return result;
}

// The points of a body-centred cubic grid over the box of the nodes g that are inside the surface
// and not too near to a node.
Eigen::Matrix3Xd points_inside(const Surface& surface, const Eigen::Matrix3Xd& g, double side) {
  const Eigen::Vector3d low = g.rowwise().minCoeff(), size = g.rowwise().maxCoeff() - low;
  const Eigen::Array3d cells = (size.array() / side).ceil();
  const Eigen::Vector3d first = low + (size - side * cells.matrix()) / 2;
  const Tree tree(3, g);
  std::vector<Eigen::Vector3d> points;
  for (const double offset : {0.0, 0.5}) {
    for (double x = offset; x <= cells[0]; ++x) {
      for (double y = offset; y <= cells[1]; ++y) {
        for (double z = offset; z <= cells[2]; ++z) {
          const Eigen::Vector3d p = first + side * Eigen::Vector3d(x, y, z);
          if (within(tree, p, kLeastGap * side).empty() && surface.contains(p)) points.push_back(p);
        }
      }
    }
  }
  Eigen::Matrix3Xd result(3, std::ssize(points));
  for (Eigen::Index i = 0; i < result.cols(); ++i) result.col(i) = points[i];
  return result;
}

// The points of such a grid, which is made coarser if it has too many cells or points.
Eigen::Matrix3Xd few_points_inside(const Surface& surface, const Eigen::Matrix3Xd& g,
                                   double& side) {
  const Eigen::Array3d size = g.rowwise().maxCoeff() - g.rowwise().minCoeff();
  side *= std::cbrt(std::max(1.0, (size / side).ceil().max(1).prod() / kMostCells));
  for (;;) {
    Eigen::Matrix3Xd points = points_inside(surface, g, side);
    const double excess =
        static_cast<double>(points.cols()) / (kMostPerNode * static_cast<double>(g.cols()));
    if (excess <= 1) return points;
    side *= std::max(1.05, std::cbrt(excess));
  }
}

// Joins the nodes behind the first `on_surface` ones to all nodes around them.
void join_inside(const Surface& surface, Eigen::Index on_surface, double reach,
                 DeformationGraph& graph) {
  const Tree tree(3, graph.g);
  for (auto k = static_cast<int>(on_surface); k < graph.g.cols(); ++k) {
    const Eigen::Vector3d inside = graph.g.col(k);
    for (const int j : within(tree, inside, reach)) {
      if (j >= k) break;
      const double share = j < on_surface ? 1 - kOnSurface : 1;
      const Eigen::Vector3d end = inside + share * (graph.g.col(j) - inside);
      if (!surface.meets(inside, end)) graph.edges.push_back({j, k, 1});
    }
  }
  std::ranges::sort(graph.edges, {}, [](const GraphEdge& e) { return std::pair(e.j, e.k); });
}

// Leaves out the nodes behind the first `on_surface` ones that no path joins to one of these.
void leave_out_lone_nodes(Eigen::Index on_surface, DeformationGraph& graph) {
  const std::vector<int> component = components(graph);
  const int last = *std::max_element(component.begin(), component.begin() + on_surface);
  std::vector<int> number(component.size(), -1), kept;
  for (std::size_t j = 0; j < component.size(); ++j) {
    if (component[j] > last) continue;  // components are numbered in the order of their first nodes
    number[j] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(j));
  }
  graph.g = Eigen::Matrix3Xd(graph.g(Eigen::all, kept));
  std::erase_if(graph.edges, [&](const GraphEdge& edge) { return number[edge.k] < 0; });
  for (GraphEdge& edge : graph.edges) edge.j = number[edge.j], edge.k = number[edge.k];
}

}  // namespace

std::optional<std::string> why_open(const Shape& shape) {
  std::vector<Side> sides;
  for (const auto& t : proper_triangles(shape)) {
    for (int c = 0; c < 3; ++c) sides.push_back(std::minmax(t[c], t[(c + 1) % 3]));
  }
  if (sides.empty()) return "the shape has no faces";
  std::ranges::sort(sides);
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::upper_bound(begin, sides.end(), *begin);
    const auto count = end - begin;
    if (count % 2 != 0) {
      return fmt::format(
          "the surface is open at the edge of vertices {} and {}, which has {} triangle{}",
          begin->first, begin->second, count, count == 1 ? "" : "s");
    }
    begin = end;
  }
  return std::nullopt;
}

DeformationGraph with_interior(const Shape& shape, const DeformationGraph& graph, double spacing,
                               EdgeWeights alpha) {
  const Eigen::Index m = graph.g.cols();
  double side = m < 2 ? 0 : spacing * mean_gap(graph.g);
  if (!(side > 0)) return graph;
  const Surface surface(shape);
  const Eigen::Matrix3Xd inside = few_points_inside(surface, graph.g, side);
  DeformationGraph result{Eigen::Matrix3Xd(3, m + inside.cols()), graph.edges};
  result.g << graph.g, inside;
  join_inside(surface, m, kReach * side, result);
  leave_out_lone_nodes(m, result);
  if (alpha == EdgeWeights::kLength) weigh_by_length(result);
  return result;
}

}  // namespace deformlab
