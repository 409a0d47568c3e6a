#include "geometry/delaunay_mesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/lloyd_optimize_mesh_2.h>

#include <unordered_map>

namespace deformlab {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

constexpr double kAngle = 0.125;  // the squared sine of the least angle, 20.7°
constexpr double kLongest = 1.4;  // edge, in units of the spacing: makes edges of about one

// CGAL sorts vertices by their address unless they are stamped: results would differ between runs.
template <class Base = CGAL::Delaunay_mesh_vertex_base_2<Kernel>>
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

using Structure =
    CGAL::Triangulation_data_structure_2<StampedVertex<>, CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;

// What the mesher has to mend: small angles and, of a scale above 0, edges longer than that many
// times the spacing.
class Criteria : public CGAL::Delaunay_mesh_size_criteria_2<Delaunay> {
 public:
  using Base = CGAL::Delaunay_mesh_size_criteria_2<Delaunay>;
  Criteria(const Spacing& spacing, double scale)
      : Base(kAngle, scale), spacing_(&spacing), scale_(scale) {}

  struct Is_bad : Base::Is_bad {
    using Base::Is_bad::operator();
    Is_bad(const Base::Is_bad& base, const Spacing* lengths, double times)
        : Base::Is_bad(base), spacing(lengths), scale(times) {}

    CGAL::Mesh_2::Face_badness operator()(const Delaunay::Face_handle& face, Quality& q) const {
      const Point center = CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(),
                                          face->vertex(2)->point());
      const double longest = scale * (*spacing)({center.x(), center.y()});
      return typename Base::Is_bad(kAngle, longest, Kernel())(face, q);
    }
    const Spacing* spacing;
    double scale;
  };
  Is_bad is_bad_object() const { return {Base::is_bad_object(), spacing_, scale_}; }

 private:
  const Spacing* spacing_;
  double scale_;
};

void insert(const Eigen::Matrix2Xd& polygon, Delaunay& delaunay) {
  std::vector<Point> corners;
  for (const auto& corner : polygon.colwise()) corners.emplace_back(corner[0], corner[1]);
  delaunay.insert_constraint(corners.begin(), corners.end(), true);
}

using Mesher = CGAL::Delaunay_mesher_2<Delaunay, Criteria>;

// The middle of the largest triangle in a polygon.
Point place_in(const Eigen::Matrix2Xd& polygon) {
  Delaunay delaunay;
  insert(polygon, delaunay);
  const std::vector<Point> none;
  Mesher::mark_facets(delaunay, none.begin(), none.end());
  double largest = -1;
  Point result;
  for (const auto face : delaunay.finite_face_handles()) {
    const auto triangle = delaunay.triangle(face);
    if (!face->is_in_domain() || triangle.area() <= largest) continue;
    largest = triangle.area();
    result = CGAL::centroid(triangle);
  }
  return result;
}

void refine(Delaunay& delaunay, const std::vector<Point>& seeds, const Criteria& criteria) {
  Mesher mesher(delaunay, criteria);
  mesher.set_seeds(seeds.begin(), seeds.end());
  mesher.refine_mesh();
}

void relax(Delaunay& delaunay, const std::vector<Point>& seeds, int passes) {
  namespace parameters = CGAL::parameters;
  // Never stopped by a clock; freezing vertices would need CGAL's order of them to stay as it is.
  CGAL::lloyd_optimize_mesh_2(delaunay, parameters::max_iteration_number = passes,
                              parameters::convergence = 0.0, parameters::freeze_bound = 0.0,
                              parameters::seeds_begin = seeds.begin(),
                              parameters::seeds_end = seeds.end());
}

Triangulation extracted(const Delaunay& delaunay) {
  std::unordered_map<Delaunay::Vertex_handle, int> number;
  std::vector<Eigen::Vector2d> V;
  std::vector<Eigen::Vector3i> F;
  for (const auto face : delaunay.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    Eigen::Vector3i corners;
    for (int k = 0; k < 3; ++k) {
      const auto vertex = face->vertex(k);
      const auto [known, added] = number.try_emplace(vertex, static_cast<int>(V.size()));
      if (added) V.emplace_back(vertex->point().x(), vertex->point().y());
      corners[k] = known->second;
    }
    F.push_back(corners);
  }
  return {Eigen::Map<Eigen::Matrix2Xd>(V[0].data(), 2, static_cast<Eigen::Index>(V.size())),
          Eigen::Map<Eigen::Matrix3Xi>(F[0].data(), 3, static_cast<Eigen::Index>(F.size()))};
}

}  // namespace

Triangulation delaunay_mesh(const Region& region, const Spacing& spacing, int passes) {
  Delaunay delaunay;
  insert(region.outline, delaunay);
  std::vector<Point> seeds;
  for (const auto& hole : region.holes) {
    insert(hole, delaunay);
    seeds.push_back(place_in(hole));
  }
  refine(delaunay, seeds, {spacing, kLongest});
  if (passes > 0) {
    relax(delaunay, seeds, passes);
    refine(delaunay, seeds, {spacing, 0});
  }
  return extracted(delaunay);
}

}  // namespace deformlab
