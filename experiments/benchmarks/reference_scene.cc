#include "experiments/benchmarks/reference_scene.h"

#include <cmath>
#include <map>
#include <numbers>

#include "experiments/scenes/scene.h"
#include "geometry/graph/placement/sampling.h"

namespace deformlab {
namespace {

constexpr int kSide = 201;
constexpr int kStrips = 20;  // strips that would cover the whole side
constexpr int kArmadilloHandles = 10;
constexpr double kArmadilloPull = 0.1;  // of its size

// Each of these vertices is the one that is farthest from those before it.
std::vector<int> far_apart(const Eigen::Matrix3Xd& V, int count) {
  std::vector<int> result;
  Eigen::Index next = 0;
  Eigen::RowVectorXd least = Eigen::RowVectorXd::Constant(V.cols(), 1e300);
  while (static_cast<int>(result.size()) < count) {
    result.push_back(static_cast<int>(next));
    least = least.cwiseMin((V.colwise() - V.col(next)).colwise().squaredNorm().eval());
    least.maxCoeff(&next);
  }
  return result;
}

}  // namespace

ReferenceScene lifted_plane(int n) {
  ReferenceScene scene{bumpy_plane(n), {}, {}};
  const int strip = n / kStrips;
  for (int i = 0; i < n * n; ++i) {
    const int x = i % n;
    if (x < strip || x >= n - strip) scene.handles.moved.push_back(i);
  }
  scene.targets = scene.shape.V(Eigen::all, scene.handles.moved);
  for (std::size_t l = 0; l < scene.handles.moved.size(); ++l) {
    if (scene.handles.moved[l] % n >= strip) scene.targets(2, l) += 0.5;
  }
  return scene;
}

Shape bumpy_plane(int n) {
  Shape shape;
  shape.V.resize(3, n * n);
  for (int i = 0; i < n * n; ++i) {
    const int column = i % n, row = i / n;
    const double x = double(column) / (n - 1), y = double(row) / (n - 1);
    const double k = 10 * std::numbers::pi;
    shape.V.col(i) << x, y, 0.02 * std::sin(k * x) * std::sin(k * y);
  }
  for (int i = 0; i < n * (n - 1); ++i) {
    if (i % n < n - 1) shape.faces.push_back({i, i + 1, i + n + 1, i + n});
  }
  shape.N = vertex_normals(shape);
  return shape;
}

const ReferenceScene& reference_scene() {
  static const ReferenceScene scene = lifted_plane(kSide);
  return scene;
}

const ReferenceScene& armadillo_scene() {
  static const ReferenceScene scene = [] {
    ShapeOptions options;
    options.file = "armadillo.off";
    ReferenceScene result{make_shape(options, {}), {}, {}};
    result.handles.moved = far_apart(result.shape.V, kArmadilloHandles);
    result.targets = result.shape.V(Eigen::all, result.handles.moved);
    result.targets(1, 0) += kArmadilloPull * bounding_box_diagonal(result.shape.V);
    return result;
  }();
  return scene;
}

EmbeddedDeformation reference_deformation(int m, const SolverOptions& solver, double side) {
  static std::map<int, Eigen::Matrix3Xd> nodes;
  if (!nodes.contains(m)) {
    nodes[m] = sample_nodes(reference_scene().shape, m, EmbeddedDeformationOptions{}.graph.seed);
  }
  EmbeddedDeformationOptions options;
  options.solver = solver;
  if (side == 0) return {reference_scene().shape, nodes[m], options};
  Shape shape = reference_scene().shape;
  shape.V *= side;
  options.length_unit = "1";
  return {shape, side * nodes[m], options};
}

}  // namespace deformlab
