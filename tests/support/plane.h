#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

#include "geometry/plane/region.h"
#include "geometry/plane/triangulation.h"

namespace deformlab::test {

inline Eigen::Matrix2Xd polygon(std::initializer_list<Eigen::Vector2d> corners) {
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(corners.size()));
  Eigen::Index i = 0;
  for (const auto& corner : corners) result.col(i++) = corner;
  return result;
}

inline Eigen::Matrix2Xd box(double left, double top, double right, double bottom) {
  return polygon({{left, top}, {right, top}, {right, bottom}, {left, bottom}});
}

inline Eigen::Matrix2Xd circle(const Eigen::Vector2d& center, double radius, int corners) {
  Eigen::Matrix2Xd result(2, corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    result.col(i) = center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return result;
}

/// A star with `points` outer corners at radius 100 and as many inner ones at radius `inner`.
inline Eigen::Matrix2Xd star(int points, double inner) {
  Eigen::Matrix2Xd result = circle({0, 0}, 100, 2 * points);
  for (int i = 1; i < 2 * points; i += 2) result.col(i) *= inner / 100;
  return result;
}

/// A round body with five limbs and three holes, about 180 across.
inline Region figure() {
  Eigen::Matrix2Xd outline = circle({0, 0}, 1, 400);
  for (int i = 0; i < 400; ++i) {
    const double angle = 2 * std::numbers::pi * i / 400;
    outline.col(i) *= 60 + 25 * std::cos(5 * angle) + 6 * std::sin(9 * angle);
  }
  return {outline, {circle({15, 10}, 8, 60), circle({-15, 10}, 7, 40), circle({0, -20}, 6, 40)}};
}

inline Eigen::Matrix2d rotation(double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

/// A sheet of squares cut in two: #columns × #rows vertices, `edge` apart, row by row along x.
inline Triangulation sheet(int columns, int rows, double edge = 1) {
  Triangulation mesh{Eigen::Matrix2Xd(2, columns * rows),
                     Eigen::Matrix3Xi(3, 2 * (columns - 1) * (rows - 1))};
  for (int i = 0; i < columns * rows; ++i) {
    mesh.V.col(i) = Eigen::Vector2i(i % columns, i / columns).cast<double>();
  }
  mesh.V *= edge;
  int t = 0;
  for (int y = 0; y + 1 < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const int v = y * columns + x, below = v + columns;
      mesh.F.col(t++) << v, v + 1, below + 1;
      mesh.F.col(t++) << v, below + 1, below;
    }
  }
  return mesh;
}

/// A mesh at rest and its deformed vertices (2×#V).
struct Deformed {
  Triangulation rest;
  Eigen::Matrix2Xd V;
};

/// A closed band that winds around twice. Once around, its two sheets have changed sides.
inline Deformed twisted_band(int steps) {
  Deformed band{{Eigen::Matrix2Xd(2, 3 * steps), Eigen::Matrix3Xi(3, 4 * steps)},
                Eigen::Matrix2Xd(2, 3 * steps)};
  for (int i = 0; i < steps; ++i) {
    const double once = 2 * std::numbers::pi * (i + 0.1) / steps;
    const Eigen::Vector2d out(std::cos(once), std::sin(once));
    for (int k = 0; k < 3; ++k) {
      band.rest.V.col(3 * i + k) = (20 + k) * out;
      band.V.col(3 * i + k) = (10 + k + 0.5 * std::cos(once)) * (rotation(once) * out);
    }
    for (int k = 0; k < 2; ++k) {
      const int v = 3 * i + k, w = (3 * i + 3) % (3 * steps) + k;
      band.rest.F.col(4 * i + 2 * k) << v, v + 1, w + 1;
      band.rest.F.col(4 * i + 2 * k + 1) << v, w + 1, w;
    }
  }
  return band;
}

/// The vertices (2×#V), each coordinate of which is moved by a random number in ±size.
inline Eigen::Matrix2Xd shaken(Eigen::Matrix2Xd V, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(-size, size);
  for (auto& entry : V.reshaped()) entry += offset(random);
  return V;
}

}  // namespace deformlab::test
