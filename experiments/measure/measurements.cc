#include "experiments/measure/measurements.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/graph/deformation_graph.h"

namespace deformlab {
namespace {

// The edges b−a and c−a of a triangle in its own plane, upper triangular.
Eigen::Matrix2d flattened(const Eigen::Matrix3Xd& V, const Eigen::Vector3i& t) {
  const Eigen::Vector3d ab = V.col(t[1]) - V.col(t[0]), ac = V.col(t[2]) - V.col(t[0]);
  const double length = ab.norm();
  if (length == 0) return Eigen::Matrix2d::Zero();
  Eigen::Matrix2d M;
  M << length, ab.dot(ac) / length, 0, ab.cross(ac).norm() / length;
  return M;
}

struct Mean {
  double sum = 0, weight = 0, max = 0;
  void add(double value, double w) {
    sum += w * value;
    weight += w;
    max = std::max(max, value);
  }
  double mean() const { return weight > 0 ? sum / weight : 0; }
};

}  // namespace

Metrics metrics_of(const Report& report) {
  Metrics m{{"cost", report.solve.final_cost},
            {"initial_cost", report.solve.initial_cost},
            {"iterations", static_cast<double>(report.solve.iterations.size())},
            {"converged", report.solve.status == Status::kConverged ? 1.0 : 0.0},
            {"nodes", static_cast<double>(report.nodes)},
            {"edges", static_cast<double>(report.edges)},
            {"unknowns", static_cast<double>(report.solve.unknowns)},
            {"factorizations", static_cast<double>(report.solve.factorizations)},
            {"min_det_R", report.min_det_R},
            {"inside_out", static_cast<double>(report.inside_out)},
            {"handle_rms", report.handle_rms},
            {"handle_max", report.handle_max},
            {"length_unit", report.length_unit}};
  for (const auto& [term, cost] : report.solve.cost_by_term) m["cost." + term] = cost;
  return m;
}

Metrics seconds_of(const Report& report) {
  Metrics m;
  for (const auto& [phase, seconds] : report.seconds) m["seconds." + phase] = seconds;
  for (const auto& [phase, seconds] : report.solve.seconds) m["seconds.solve." + phase] = seconds;
  return m;
}

Metrics distortion(const Shape& rest, const Shape& deformed) {
  const Eigen::Matrix3Xi T = triangles(rest);
  Mean shear, stretch, edge;
  for (const auto t : T.colwise()) {
    const Eigen::Matrix2d before = flattened(rest.V, t);
    const double area = before.determinant() / 2;
    if (!(area > 0)) continue;
    const Eigen::Matrix2d gradient = flattened(deformed.V, t) * before.inverse();
    const Eigen::Vector2d s = Eigen::JacobiSVD<Eigen::Matrix2d>(gradient).singularValues();
    const double least = std::max(s[1], 1e-12);
    shear.add(s[0] / least - 1, area);
    stretch.add(std::max(s[0], 1 / least) - 1, area);
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const double length = (rest.V.col(a) - rest.V.col(b)).norm();
      edge.add(std::abs((deformed.V.col(a) - deformed.V.col(b)).norm() / length - 1), 1);
    }
  }
  if (edge.weight == 0) return {};
  return {{"shear_mean", shear.mean()},
          {"shear_max", shear.max},
          {"stretch_mean", stretch.mean()},
          {"stretch_max", stretch.max},
          {"edge_error_mean", edge.mean()}};
}

Metrics region_distortion(const Shape& rest, const Shape& deformed,
                          const std::vector<int>& vertices) {
  const auto chosen = [&](int i) { return std::ranges::binary_search(vertices, i); };
  Shape part{rest.V, Eigen::Matrix3Xd(3, 0), {}};
  for (const auto& face : rest.faces) {
    if (std::ranges::all_of(face, chosen)) part.faces.push_back(face);
  }
  Metrics result;
  for (const auto& [name, value] : distortion(part, deformed)) result["region." + name] = value;
  return result;
}

int count_components(const Shape& shape) {
  DeformationGraph vertices{shape.V, {}};
  for (const auto& face : shape.faces) {
    for (std::size_t c = 1; c < face.size(); ++c) vertices.edges.push_back({face[0], face[c], 1});
  }
  return std::ranges::max(components(vertices)) + 1;
}

Metrics node_shear(const Transformations& X) {
  Mean shear;
  for (Eigen::Index j = 0; j < X.cols() / 4; ++j) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(X.middleCols<3>(4 * j));
    shear.add((svd.singularValues().array() - 1).matrix().norm(), 1);
  }
  return {{"node_shear_mean", shear.mean()}, {"node_shear_max", shear.max}};
}

namespace {

// Whether every side of a triangle is that of another one in the other direction.
bool is_closed(const Eigen::Matrix3Xi& T) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto t : T.colwise()) {
    for (int c = 0; c < 3; ++c) {
      const int a = t[c], b = t[(c + 1) % 3];
      sides[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::ranges::all_of(sides, [](const auto& side) { return side.second == 0; });
}

double signed_volume(const Eigen::Matrix3Xd& V, const Eigen::Matrix3Xi& T) {
  double sum = 0;
  for (const auto t : T.colwise()) {
    const Eigen::Vector3d a = V.col(t[0]), b = V.col(t[1]), c = V.col(t[2]);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

}  // namespace

Metrics edge_and_volume_ratios(const Shape& rest, const Shape& deformed) {
  Metrics metrics;
  double most = 0;
  for (const auto& face : rest.faces) {
    for (std::size_t c = 0; c < face.size(); ++c) {
      const int a = face[c], b = face[(c + 1) % face.size()];
      const double before = (rest.V.col(a) - rest.V.col(b)).norm();
      const double after = (deformed.V.col(a) - deformed.V.col(b)).norm();
      if (before > 0) most = std::max(most, after / before);
    }
  }
  if (most > 0) metrics["edge_ratio_max"] = most;
  const Eigen::Matrix3Xi T = triangles(rest);
  if (T.cols() == 0 || !is_closed(T)) return metrics;
  const double before = signed_volume(rest.V, T);
  if (before != 0) metrics["volume"] = signed_volume(deformed.V, T) / before;
  return metrics;
}

}  // namespace deformlab
