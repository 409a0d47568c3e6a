#pragma once

#include <Eigen/Core>
#include <string>

#include "geometry/core/options.h"
#include "geometry/plane/region.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// A region of the plane cut into triangles: the rest shape of a drawing (Igarashi et al. 2005,
/// section 3). Coordinates are those of the drawing, so pixels and y down where it is an image.
struct Triangulation {
  Eigen::Matrix2Xd V;  ///< 2×#V vertices [length]
  Eigen::Matrix3Xi F;  ///< 3×#F corners of each triangle, all turning the same way as (x, y)
};

/// How good triangles are.
struct TriangleQuality {
  double least_angle = 0;  ///< over all triangles [degree]
  double mean = 0;         ///< of 2 r_in / r_out: 1 for equilateral triangles, 0 for slivers
};

TriangleQuality quality(const Triangulation& mesh);

/// How a region is cut into triangles.
struct TriangulationOptions {
  int vertices = 300;  ///< asked for, 3 … 200,000
  /// Edges on the right of the region are this many times as long as on its left (Figure 18); 1:
  /// the same everywhere. 0.1 … 10.
  double uneven = 1;

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("vertices", o.vertices, {.min = 3, .max = 200'000},
                "The number of vertices of the mesh, which is met approximately");
    visit.range("uneven", o.uneven, {.min = 0.1, .max = 10},
                "How many times as long edges are on the right as on the left");
  }
};

/// Near-equilateral triangles of similar size that follow the region's boundary: a constrained
/// Delaunay triangulation, refined and then improved iteratively (Igarashi et al. 2005, section 3).
/// The number of vertices is met within 3 % from 80 on where the region's corners, holes and thin
/// parts leave room; they can ask for more. One connected mesh, every vertex used; the same input
/// gives the same bytes. Throws InputError for options out of range, for a region that `checked`
/// refuses, and for one with parts so thin that triangles would be too many (twice the number asked
/// for, 100,000 at least) or their coordinates had too few digits; `name` is what the message calls
/// it.
Triangulation triangulate(const Region& region, const TriangulationOptions& options,
                          const std::string& name);

/// The faces of a flat shape, z equal everywhere, cut into triangles; vertices keep their numbers.
/// A mesh that is turned over as a whole is turned back. Throws InputError as `check` does, and
/// where the shape is not flat (to a millionth of its extent), has no triangle, a triangle without
/// area or one that turns the other way than the first, or a vertex that no triangle has. `name` is
/// what the message calls it.
Triangulation flat(const Shape& shape, const std::string& name);

/// The same with z = 0, for what takes a shape.
Shape to_shape(const Triangulation& mesh);

}  // namespace deformlab
