#pragma once

#include <Eigen/Core>
#include <string>

#include "geometry/core/options.h"
#include "geometry/plane/region.h"
#include "geometry/shape/shape.h"

namespace deformlab {

/// A region of the plane cut into triangles, which is the rest shape of a drawing (Igarashi et al.
/// 2005, section 3). Coordinates are those of the drawing; in an image they are pixels, and y
/// points down.
struct Triangulation {
  Eigen::Matrix2Xd V;  ///< 2×#V vertices [length]
  Eigen::Matrix3Xi F;  ///< 3×#F corners of each triangle, all turning the same way as (x, y)
};

/// Throws InputError for a triangle that names a vertex which does not exist, and for a vertex that
/// is not finite. The functions below and the classes that take a triangulation do so as well.
void check(const Triangulation& mesh);

/// The area of the triangle f of vertices at V (2×#V), negative where it turns the other way than
/// (x, y) [length²].
double signed_area(const Eigen::Matrix2Xd& V, const Eigen::Vector3i& f);

/// The quality of triangles.
struct TriangleQuality {
  double least_angle = 0;  ///< over all triangles [degree]
  double mean = 0;         ///< mean of 2 r_in / r_out, 1 for equilateral triangles, 0 for slivers
};

TriangleQuality quality(const Triangulation& mesh);

struct TriangulationOptions {
  int vertices = 0;   ///< 0: as many as suit the widths of the region's limbs
  double uneven = 1;  ///< as in Figure 18; 1 makes edges of the same length everywhere

  template <class Self, class Visit>
  static void fields(Self& o, Visit&& visit) {
    visit.range("vertices", o.vertices, {.min = 0, .max = 200'000},
                "The number of vertices of the mesh, which is met approximately; 0 takes 300 to "
                "2000, so that edges are about as long as the limbs of the drawing are wide");
    visit.range("uneven", o.uneven, {.min = 0.1, .max = 10},
                "How many times as long edges are on the right as on the left");
  }
};

/// The number of vertices with which edges are about as long as the region's limbs are wide in the
/// mean, but at least 300 and at most 2000.
int suited_vertices(const Region& region);

/// The mean length of the triangles' edges, each triangle with its own [length]; 0 without any.
double mean_edge_length(const Triangulation& mesh);

/// Cuts a region into nearly equilateral triangles of similar size: a constrained Delaunay
/// triangulation that is refined and then improved iteratively (Igarashi et al. 2005, section 3).
/// From 80 vertices on their number is met within 3 %, unless the region's corners, holes and thin
/// parts need more. The mesh is connected and uses every vertex, and the same input gives the same
/// bytes. Throws InputError for options out of range, for a region that `checked` refuses, and for
/// a region so thin that it needs more than 100,000 vertices and more than twice the given number,
/// or that coordinates would have too few digits. `name` is what the message calls the region.
Triangulation triangulate(const Region& region, const TriangulationOptions& options,
                          const std::string& name);

/// The faces of a flat shape, where all z are equal, cut into triangles. Vertices keep their
/// numbers. Where all triangles turn the wrong way, all of them are reversed. Throws InputError as
/// `check` does, and where the shape is not flat (to a millionth of its extent), has no triangle, a
/// triangle without area or one that turns the other way than the first, or a vertex in no
/// triangle. `name` is what the message calls the shape.
Triangulation flat(const Shape& shape, const std::string& name);

/// Appends the vertices and triangles of a part.
void append(const Triangulation& part, Triangulation& mesh);

/// The triangulation as a shape with z = 0.
Shape to_shape(const Triangulation& mesh);

}  // namespace deformlab
