#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "geometry/shape/shape.h"

namespace deformlab::test {

/// n×n vertices over [0, side]², row by row along x, with bumps of `height`; quads, normals.
inline Shape bumpy_plane(int n, double side = 1, double height = 0.02) {
  Shape shape;
  shape.V.resize(3, n * n);
  for (int i = 0; i < n * n; ++i) {
    const int column = i % n, row = i / n;
    const double x = double(column) / (n - 1), y = double(row) / (n - 1);
    const double z = height * std::sin(10 * std::numbers::pi * x + 0.3) * std::cos(9 * y);
    shape.V.col(i) = side * Eigen::Vector3d(x, y, z);
  }
  for (int y = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x) {
      const int a = y * n + x;
      shape.faces.push_back({a, a + 1, a + 1 + n, a + n});
    }
  }
  shape.N = vertex_normals(shape);
  return shape;
}

/// An open tube along x, `rings` rings of 12 vertices each, radius 1, rings 0.5 apart.
inline Shape tube(int rings) {
  constexpr int kSectors = 12;
  Shape shape;
  shape.V.resize(3, rings * kSectors);
  for (int i = 0; i < rings * kSectors; ++i) {
    const int ring = i / kSectors, sector = i % kSectors;
    const double angle = 2 * std::numbers::pi * sector / kSectors;
    shape.V.col(i) << 0.5 * ring, std::cos(angle), std::sin(angle);
  }
  for (int i = 0; i + kSectors < rings * kSectors; ++i) {
    const int next = i % kSectors == kSectors - 1 ? i + 1 - kSectors : i + 1;
    shape.faces.push_back({i, next, next + kSectors, i + kSectors});
  }
  shape.N = vertex_normals(shape);
  return shape;
}

/// n points, uniform in the box [0, size.x] × [0, size.y] × [0, size.z].
inline Eigen::Matrix3Xd random_points(int n, const Eigen::Vector3d& size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  Eigen::Matrix3Xd points(3, n);
  for (auto& entry : points.reshaped()) entry = uniform(random);
  return size.asDiagonal() * points;
}

/// n points without faces.
inline Shape point_set(int n, unsigned seed = 1) {
  return {random_points(n, {1, 1, 1}, seed), Eigen::Matrix3Xd(3, 0), {}};
}

/// n triangles that share no vertex, one with corners in a line and one named twice among them.
inline Shape soup(int n, unsigned seed = 1) {
  Shape shape = point_set(3 * n, seed);
  for (int t = 0; t < n; ++t) shape.faces.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  shape.V.col(2) = (shape.V.col(0) + shape.V.col(1)) / 2;
  shape.faces.push_back(shape.faces.back());
  return shape;
}

/// The surface of the unit cubes of an nx×ny×nz grid that has(x, y, z) chooses, as quads. It is
/// closed.
template <class Has>
Shape cubes(int nx, int ny, int nz, const Has& has) {
  std::map<std::array<int, 3>, int> number;
  Shape shape;
  const auto has_cell = [&](const std::array<int, 3>& c) {
    const bool is_in = c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < nx && c[1] < ny && c[2] < nz;
    return is_in && has(c[0], c[1], c[2]);
  };
  const auto add_side = [&](std::array<int, 3> corner, int axis, bool is_upper) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    corner[axis] += is_upper;
    std::vector<int> face;
    for (const auto& [du, dv] :
         {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      std::array<int, 3> p = corner;
      p[u] += du, p[v] += dv;
      face.push_back(number.try_emplace(p, static_cast<int>(number.size())).first->second);
    }
    if (!is_upper) std::reverse(face.begin(), face.end());
    shape.faces.push_back(face);
  };
  for (int i = 0; i < nx * ny * nz; ++i) {
    const std::array<int, 3> cell = {i % nx, i / nx % ny, i / nx / ny};
    for (int side = 0; side < 6 && has_cell(cell); ++side) {
      std::array<int, 3> other = cell;
      other[side / 2] += side % 2 == 1 ? 1 : -1;
      if (!has_cell(other)) add_side(cell, side / 2, side % 2 == 1);
    }
  }
  shape.V.resize(3, std::ssize(number));
  for (const auto& [p, i] : number) shape.V.col(i) << p[0], p[1], p[2];
  return shape;
}

/// Both in one shape, `b` moved by `offset`; without normals.
inline Shape side_by_side(Shape a, const Shape& b, const Eigen::Vector3d& offset) {
  const int first = static_cast<int>(a.V.cols());
  a.N.resize(3, 0);
  a.V.conservativeResize(3, first + b.V.cols());
  a.V.rightCols(b.V.cols()) = b.V.colwise() + offset;
  for (auto face : b.faces) {
    for (int& v : face) v += first;
    a.faces.push_back(face);
  }
  return a;
}

}  // namespace deformlab::test
