#include "geometry/plane/triangulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/core/error.h"
#include "geometry/plane/cross.h"

namespace deformlab {

void check(const Triangulation& mesh) {
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) {
    const Eigen::Vector3i corners = mesh.F.col(t);
    if (corners.minCoeff() >= 0 && corners.maxCoeff() < mesh.V.cols()) continue;
    throw InputError(fmt::format(
        "triangle {} (vertices {}, {}, {}) names a vertex that the mesh does not have; its "
        "vertices are 0 to {}",
        t, corners[0], corners[1], corners[2], mesh.V.cols() - 1));
  }
  for (Eigen::Index v = 0; v < mesh.V.cols(); ++v) {
    if (mesh.V.col(v).allFinite()) continue;
    throw InputError(fmt::format(
        "vertex {} of the mesh (counted from 0) is at ({}, {}); every number must be finite", v,
        mesh.V(0, v), mesh.V(1, v)));
  }
}

double signed_area(const Eigen::Matrix2Xd& V, const Eigen::Vector3i& f) {
  return cross(V.col(f[1]) - V.col(f[0]), V.col(f[2]) - V.col(f[0])) / 2;
}

TriangleQuality quality(const Triangulation& mesh) {
  check(mesh);
  TriangleQuality result{.least_angle = 180};
  for (const auto& t : mesh.F.colwise()) {
    double product = 1, around = 0, twice_area = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d u = mesh.V.col(t[(k + 1) % 3]) - mesh.V.col(t[k]);
      const Eigen::Vector2d v = mesh.V.col(t[(k + 2) % 3]) - mesh.V.col(t[k]);
      twice_area = std::abs(cross(u, v));
      const double angle = std::atan2(twice_area, u.dot(v)) * 180 / std::numbers::pi;
      result.least_angle = std::min(result.least_angle, angle);
      product *= u.norm();
      around += u.norm();
    }
    // r_in = 2A / (a + b + c), r_out = abc / 4A
    result.mean += 4 * twice_area * twice_area / (around * product);
  }
  result.mean /= static_cast<double>(mesh.F.cols());
  return result;
}

double mean_edge_length(const Triangulation& mesh) {
  double sum = 0;
  for (const auto& f : mesh.F.colwise()) {
    for (int c = 0; c < 3; ++c) sum += (mesh.V.col(f[(c + 1) % 3]) - mesh.V.col(f[c])).norm();
  }
  return sum / std::max(1.0, static_cast<double>(mesh.F.size()));
}

void append(const Triangulation& part, Triangulation& mesh) {
  check(part);
  const Eigen::Index vertices = mesh.V.cols(), triangles = mesh.F.cols();
  mesh.V.conservativeResize(2, vertices + part.V.cols());
  mesh.F.conservativeResize(3, triangles + part.F.cols());
  mesh.V.rightCols(part.V.cols()) = part.V;
  mesh.F.rightCols(part.F.cols()) = part.F.array() + static_cast<int>(vertices);
}

Shape to_shape(const Triangulation& mesh) {
  check(mesh);
  Shape shape;
  shape.V = Eigen::Matrix3Xd::Zero(3, mesh.V.cols());
  shape.V.topRows<2>() = mesh.V;
  for (const auto& t : mesh.F.colwise()) shape.faces.push_back({t[0], t[1], t[2]});
  return shape;
}

}  // namespace deformlab
