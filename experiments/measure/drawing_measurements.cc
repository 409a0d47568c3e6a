#include "experiments/measure/drawing_measurements.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace deformlab {
namespace {

using Complex = std::complex<double>;

double twice_area(const Eigen::Matrix2Xd& V, const Eigen::Vector3i& f) {
  const Eigen::Vector2d a = V.col(f[1]) - V.col(f[0]), b = V.col(f[2]) - V.col(f[0]);
  return a.x() * b.y() - a.y() * b.x();
}

Complex edge(const Eigen::Matrix2Xd& V, const Eigen::Vector3i& f, int i) {
  const Eigen::Vector2d e = V.col(f[(i + 1) % 3]) - V.col(f[i]);
  return {e.x(), e.y()};
}

// Σ ‖e'' − R e‖² of one triangle with its best rotation R.
double rigid_residual(const Eigen::Matrix2Xd& rest, const Eigen::Matrix2Xd& V,
                      const Eigen::Vector3i& f) {
  Complex s = 0;
  for (int i = 0; i < 3; ++i) s += std::conj(edge(rest, f, i)) * edge(V, f, i);
  const Complex R = std::abs(s) > 0 ? s / std::abs(s) : Complex(1);
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::norm(edge(V, f, i) - R * edge(rest, f, i));
  return sum;
}

Shape deformed_shape(Triangulation mesh, const Eigen::Matrix2Xd& V) {
  mesh.V = V;
  return to_shape(mesh);
}

}  // namespace

Metrics plane_distortion(const Triangulation& rest, const Eigen::Matrix2Xd& V) {
  double area = 0, area_rest = 0, residual = 0, edges = 0, flipped = 0;
  for (const auto f : rest.F.colwise()) {
    const double now = twice_area(V, f), before = twice_area(rest.V, f);
    area += std::copysign(now, now * before);
    area_rest += std::abs(before);
    flipped += now * before < 0;
    residual += rigid_residual(rest.V, V, f);
    for (int i = 0; i < 3; ++i) edges += std::norm(edge(rest.V, f, i));
  }
  Metrics m = distortion(to_shape(rest), deformed_shape(rest, V));
  m["area_ratio"] = area / area_rest;
  m["flipped"] = flipped;
  m["arap"] = residual / edges;
  return m;
}

Metrics painted_distortion(const Triangulation& rest, const Eigen::Matrix2Xd& V,
                           const Eigen::VectorXd& weights) {
  Triangulation painted{rest.V, Eigen::Matrix3Xi(3, (weights.array() != 1).count())};
  for (Eigen::Index f = 0, to = 0; f < rest.F.cols(); ++f) {
    if (weights[f] != 1) painted.F.col(to++) = rest.F.col(f);
  }
  const Metrics all = distortion(to_shape(painted), deformed_shape(painted, V));
  if (all.empty()) return {};
  return {{"painted_shear_max", all.at("shear_max")},
          {"painted_stretch_max", all.at("stretch_max")}};
}

Metrics off_line(const Triangulation& rest, const Eigen::Matrix2Xd& V, const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b) {
  const double length = (b - a).norm();
  if (!(length > 0)) return {};
  const Eigen::Vector2d normal = Eigen::Vector2d(a.y() - b.y(), b.x() - a.x()) / length;
  const double most = (normal.transpose() * (V - rest.V)).cwiseAbs().maxCoeff();
  return {{"off_line_max", most / length}};
}

}  // namespace deformlab
