#include "geometry/plane/delaunay_relaxation.h"

#include <vector>

namespace deformlab {
namespace {

using Point = DelaunayKernel::Point_2;
using Vertex = Delaunay::Vertex_handle;

constexpr double kStep = 1.8;  // in units of the way to the centroid; 1 takes twice as many passes

// The centroid of a vertex's Voronoi cell. The density s⁻⁴ leads to edges of length s.
Point center_of_cell(const Delaunay& delaunay, Vertex vertex, const Spacing& spacing) {
  const Point center = vertex->point();
  auto face = delaunay.incident_faces(vertex);
  const auto first = face;
  Point from = delaunay.circumcenter(face);
  DelaunayKernel::Vector_2 moment(0, 0);
  double mass = 0;
  do {
    const Point to = delaunay.circumcenter(++face);
    const Point middle = CGAL::centroid(center, from, to);
    const double s = spacing({middle.x(), middle.y()});
    const double share = CGAL::area(center, from, to) / (s * s) / (s * s);
    moment += share * (middle - center);
    mass += share;
    from = to;
  } while (face != first);
  return mass > 0 ? center + moment / mass : center;
}

// Whether all triangles around a vertex keep their orientation when it moves.
bool fits(const Delaunay& delaunay, Vertex vertex, const Point& place) {
  auto face = delaunay.incident_faces(vertex);
  const auto first = face;
  do {
    const int k = face->index(vertex);
    const Point a = face->vertex(Delaunay::ccw(k))->point();
    const Point b = face->vertex(Delaunay::cw(k))->point();
    if (CGAL::orientation(place, a, b) != CGAL::LEFT_TURN) return false;
  } while (++face != first);
  return true;
}

void move(Delaunay& delaunay, const std::vector<Vertex>& vertices, const Spacing& spacing) {
  std::vector<Point> places;
  for (const Vertex vertex : vertices) {
    const Point from = vertex->point();
    places.push_back(from + kStep * (center_of_cell(delaunay, vertex, spacing) - from));
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (fits(delaunay, vertices[i], places[i])) vertices[i]->set_point(places[i]);
  }
}

// Returns false where no edge had to be flipped.
bool flip(Delaunay& delaunay) {
  bool flipped = false;
  for (Delaunay::Face_handle face : delaunay.finite_face_handles()) {
    for (int k = 0; face->is_in_domain() && k < 3; ++k) {
      if (!delaunay.is_flipable(face, k)) continue;
      delaunay.flip(face, k);
      flipped = true;
    }
  }
  return flipped;
}

}  // namespace

void relax(Delaunay& delaunay, const Spacing& spacing, int passes) {
  std::vector<Vertex> inner;
  for (const Vertex vertex : delaunay.finite_vertex_handles()) {
    if (!delaunay.are_there_incident_constraints(vertex)) inner.push_back(vertex);
  }
  for (int pass = 0; pass < passes; ++pass) {
    move(delaunay, inner, spacing);
    while (flip(delaunay)) {
    }
  }
}

}  // namespace deformlab
