#include "geometry/plane/delaunay_mesh.h"

#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <limits>
#include <unordered_map>

#include "geometry/plane/delaunay.h"
#include "geometry/plane/delaunay_relaxation.h"

namespace deformlab {
namespace {

using Point = DelaunayKernel::Point_2;

constexpr double kAngle = 0.125;  // the squared sine of the least angle, 20.7°
constexpr double kLongest = 1.4;  // longest edge in units of the spacing; makes edges of about 1
constexpr int kMostSteps = 20;    // per vertex; a step adds a vertex or finds that none is needed

// The mesher has to remove small angles and, where the scale is above 0, edges longer than the
// spacing times the scale.
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
      return typename Base::Is_bad(kAngle, longest, DelaunayKernel())(face, q);
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

// A point inside a polygon: the centroid of its largest triangle.
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

class Refiner {
 public:
  Refiner(const Region& region, const Spacing& spacing, int most_vertices)
      : spacing_(spacing), most_(static_cast<std::size_t>(most_vertices)) {
    insert(region.outline, delaunay_);
    for (const auto& hole : region.holes) {
      insert(hole, delaunay_);
      seeds_.push_back(place_in(hole));
    }
  }

  // Adds vertices where edges are longer than `longest` times the spacing (unless `longest` is 0)
  // or angles are too small, at the longest edges first, until there are enough. Returns false
  // where there would be too many or where many steps do not suffice.
  bool refine(double longest, std::size_t enough) {
    Mesher mesher(delaunay_, {spacing_, longest});
    mesher.set_seeds(seeds_.begin(), seeds_.end());
    mesher.init();
    for (std::size_t step = 0; step < kMostSteps * most_; ++step) {
      if (delaunay_.number_of_vertices() > most_) return false;
      if (delaunay_.number_of_vertices() >= enough) return true;
      if (!mesher.try_one_step_refine_mesh()) return true;
    }
    return false;
  }

  Delaunay& delaunay() { return delaunay_; }

 private:
  Delaunay delaunay_;
  std::vector<Point> seeds_;
  const Spacing& spacing_;
  std::size_t most_;
};

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

std::optional<Triangulation> delaunay_mesh(const Region& region, const Spacing& spacing,
                                           const Refinement& refinement) {
  constexpr std::size_t kNeverEnough = std::numeric_limits<std::size_t>::max();
  const auto least = static_cast<std::size_t>(refinement.least_vertices);
  Refiner refiner(region, spacing, refinement.most_vertices);
  if (!refiner.refine(kLongest, kNeverEnough)) return {};
  if (!refiner.refine(kLongest / 2, least)) return {};
  relax(refiner.delaunay(), spacing, refinement.passes);
  if (!refiner.refine(0, kNeverEnough)) return {};
  return extracted(refiner.delaunay());
}

}  // namespace deformlab
