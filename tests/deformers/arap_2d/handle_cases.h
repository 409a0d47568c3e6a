#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "geometry/plane/barycentric_point.h"
#include "geometry/plane/triangulation.h"
#include "tests/support/samples.h"

namespace deformlab::test {

/// A square of 11×11 vertices.
inline Triangulation square() { return shaken_grid(11, 5); }

inline Eigen::VectorXd ones(const Triangulation& mesh) {
  return Eigen::VectorXd::Ones(mesh.F.cols());
}

/// Weights of 1, except for some triangles.
inline Eigen::VectorXd painted(const Triangulation& mesh, double weight) {
  Eigen::VectorXd weights = ones(mesh);
  weights.segment(20, 12).setConstant(weight);
  return weights;
}

/// Two squares side by side, without a common vertex.
inline Triangulation two_squares() {
  const Triangulation one = square();
  const auto n = static_cast<int>(one.V.cols());
  Triangulation both{Eigen::Matrix2Xd(2, 2 * n), Eigen::Matrix3Xi(3, 2 * one.F.cols())};
  both.V << one.V, one.V.colwise() + Eigen::Vector2d(5, 0);
  both.F << one.F, one.F.array() + n;
  return both;
}

/// 2×#points: where the points are at rest.
inline Eigen::Matrix2Xd at_rest(const Triangulation& mesh,
                                const std::vector<BarycentricPoint>& points) {
  Eigen::Matrix2Xd result(2, std::ssize(points));
  for (int i = 0; i < std::ssize(points); ++i) result.col(i) = points[i].at(mesh.V);
  return result;
}

/// 2×#points: targets, each of which is moved in a way of its own.
inline Eigen::Matrix2Xd moved(const Triangulation& mesh,
                              const std::vector<BarycentricPoint>& points) {
  Eigen::Matrix2Xd targets = at_rest(mesh, points);
  for (Eigen::Index i = 0; i < targets.cols(); ++i) {
    const auto t = static_cast<double>(i);
    targets.col(i) += Eigen::Vector2d(std::sin(2 * t + 1), 0.7 * std::cos(3 * t));
  }
  return targets;
}

/// Handles as users choose them.
struct HandleCase {
  const char* name;
  std::vector<BarycentricPoint> points;
};

inline std::vector<HandleCase> handle_cases(const Triangulation& mesh) {
  const auto in = [&](int f, double a, double b) {
    return BarycentricPoint{mesh.F.col(f), {a, b, 1 - a - b}};
  };
  std::vector<BarycentricPoint> crowd;
  for (int v = 0; v < 20; ++v) crowd.push_back(BarycentricPoint::at_vertex(6 * v + v % 3));
  std::vector<BarycentricPoint> mixed = crowd, throng;
  for (int v = 0; v < 40; ++v) throng.push_back(BarycentricPoint::at_vertex(3 * v));
  for (const int f : {30, 70, 150}) mixed.push_back(in(f, 0.3, 0.2));
  return {
      {"two_vertices", {BarycentricPoint::at_vertex(0), BarycentricPoint::at_vertex(120)}},
      {"three_vertices",
       {BarycentricPoint::at_vertex(0), BarycentricPoint::at_vertex(60),
        BarycentricPoint::at_vertex(117)}},
      {"points_inside", {in(3, 0.2, 0.5), in(100, 0.1, 0.1), in(190, 0.6, 0.3)}},
      {"vertex_and_point", {BarycentricPoint::at_vertex(5), in(150, 0.25, 0.25)}},
      {"one_triangle", {in(80, 0.8, 0.1), in(80, 0.1, 0.8), in(10, 0.3, 0.3)}},
      {"neighbours", {in(80, 0.8, 0.1), in(81, 0.2, 0.3), in(83, 0.4, 0.4), in(4, 0.3, 0.3)}},
      {"on_an_edge", {in(40, 0, 0.4), in(120, 0.5, 0.5), BarycentricPoint::at_vertex(10)}},
      {"twenty_vertices", crowd},
      {"many_of_both", mixed},
      {"forty_vertices", throng},
  };
}

/// The as-rigid-as-possible energy of positions V (2×#V), with weights of 1.
inline double arap_energy(const Triangulation& mesh, const Eigen::Matrix2Xd& V) {
  double energy = 0;
  for (const auto f : mesh.F.colwise()) {
    std::complex<double> s = 0;
    std::array<std::complex<double>, 3> e, e_rest;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector2d a = V.col(f[(c + 1) % 3]) - V.col(f[c]);
      const Eigen::Vector2d b = mesh.V.col(f[(c + 1) % 3]) - mesh.V.col(f[c]);
      e[c] = {a.x(), a.y()};
      e_rest[c] = {b.x(), b.y()};
      s += std::conj(e_rest[c]) * e[c];
    }
    for (int c = 0; c < 3; ++c) energy += std::norm(e[c] - s / std::abs(s) * e_rest[c]);
  }
  return energy;
}

}  // namespace deformlab::test
