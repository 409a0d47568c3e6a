#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_2.h>

#include <cstddef>

namespace deformlab {

using DelaunayKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A vertex with a time stamp. Without one CGAL sorts vertices by their addresses, and results
/// would differ between runs.
template <class Base = CGAL::Triangulation_vertex_base_2<DelaunayKernel>>
class StampedVertex : public Base {
 public:
  using Base::Base;
  template <class Structure>
  struct Rebind_TDS {
    using Other = StampedVertex<typename Base::template Rebind_TDS<Structure>::Other>;
  };
  using Has_timestamp = CGAL::Tag_true;
  std::size_t time_stamp() const { return stamp_; }
  void set_time_stamp(std::size_t stamp) { stamp_ = stamp; }

 private:
  std::size_t stamp_ = static_cast<std::size_t>(-1);
};

/// Constrained edges are the boundary of a region. A face knows whether it is inside.
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<
    DelaunayKernel, CGAL::Triangulation_data_structure_2<
                        StampedVertex<>, CGAL::Delaunay_mesh_face_base_2<DelaunayKernel>>>;

}  // namespace deformlab
