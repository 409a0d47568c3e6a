#include "experiments/scenes/rod.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "geometry/core/options.h"

namespace deformlab {
namespace {

Eigen::Vector2d corner(const RodOptions& o, int side) {
  const double angle = 2 * std::numbers::pi * (side + 0.5) / o.sides;
  return o.radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace

Shape make_rod(const RodOptions& o) {
  check_options(o);
  if (o.sides < 3) {
    throw OptionError("sides", fmt::format("{}", o.sides), "; a cross-section has 3 sides or more");
  }
  const int around = o.sides * o.columns, bottom = around * (o.rings + 1), top = bottom + 1;
  Shape shape;
  shape.V.resize(3, top + 1);
  for (int j = 0; j <= o.rings; ++j) {
    for (int i = 0; i < around; ++i) {
      const double along = static_cast<double>(i % o.columns) / o.columns;
      const Eigen::Vector2d p =
          (1 - along) * corner(o, i / o.columns) + along * corner(o, i / o.columns + 1);
      shape.V.col(j * around + i) << p, o.length * j / o.rings;
    }
  }
  shape.V.col(bottom).setZero();
  shape.V.col(top) << 0, 0, o.length;
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around, last = around * o.rings;
    for (int j = 0; j < o.rings; ++j) {
      const int a = j * around + i, b = j * around + next;
      shape.faces.push_back({a, b, b + around, a + around});
    }
    shape.faces.push_back({next, i, bottom});
    shape.faces.push_back({last + i, last + next, top});
  }
  return shape;
}

}  // namespace deformlab
