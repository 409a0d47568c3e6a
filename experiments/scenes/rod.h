#pragma once

#include "geometry/shape/shape.h"

namespace deformlab {

/// A closed rod along z: a prism over a regular polygon, whose sides are divided into quads.
struct RodOptions {
  int sides = 0;        ///< of the polygon; 0: there is no rod
  int rings = 60;       ///< rows of quads along z
  int columns = 1;      ///< columns of quads on each side
  double radius = 0.2;  ///< of the polygon's corners [length]
  double length = 2;    ///< along z, from 0 [length]

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("sides", o.sides, {.min = 0, .max = 2000},
                "The number of sides of its cross-section: 4 for a bar, many for a cylinder; 0: "
                "there is no rod");
    visit.range("rings", o.rings, {.min = 1, .max = 4000}, "The number of rows of quads along z");
    visit.range("columns", o.columns, {.min = 1, .max = 1000},
                "The number of columns of quads on each side");
    visit.range("radius", o.radius, {.min = 0, .exclusive_min = true},
                "The distance of its corners from its axis [length]");
    visit.range("length", o.length, {.min = 0, .exclusive_min = true},
                "The extent along z, from 0 [length]");
  }
};

/// The rod: (rings + 1) rings of sides·columns vertices each, from below, and the centres of the
/// two ends, which are closed by triangles. Throws InputError for sizes out of range and for 1 or 2
/// sides.
Shape make_rod(const RodOptions& options);

}  // namespace deformlab
