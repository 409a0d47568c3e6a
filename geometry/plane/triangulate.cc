#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/plane/boundary_sampling.h"
#include "geometry/plane/delaunay_mesh.h"
#include "geometry/plane/polygons.h"
#include "geometry/plane/triangulation.h"
#include "geometry/shape/usable.h"

namespace deformlab {
namespace {

constexpr double kLeastDetail = 1e-9;
constexpr int kPasses = 40;  // of relaxation; more hardly improve the triangles
constexpr double kFewestSuited = 300, kMostSuited = 2000;  // vertices, if none are asked for
constexpr int kMostTries = 8;                              // to meet the number of vertices
constexpr double kFew = 0.8;          // least share of the vertices before more are added
constexpr double kMostStretch = 1.5;  // longer edges would not follow the boundary
constexpr double kBlend = 0.1;  // share of the width on either side of the middle where edges grow

// The desired length of edges over a region.
class Lengths {
 public:
  Lengths(const Region& region, double uneven)
      : left_(region.outline.row(0).minCoeff()),
        width_(region.outline.row(0).maxCoeff() - left_),
        uneven_(uneven) {}

  // Makes as many edges as if all had that length, if the right is as high as the left.
  Spacing spacing(double length) const {
    if (uneven_ == 1) return [length](const Eigen::Vector2d&) { return length; };
    const double middle = length * std::sqrt((uneven_ + 1 / uneven_) / 2);
    return [*this, middle](const Eigen::Vector2d& place) {
      const double from_middle = (place[0] - left_) / width_ - 0.5;
      const double t = std::clamp(from_middle / kBlend, -1.0, 1.0);
      return middle * std::pow(uneven_, t / 2);
    };
  }

 private:
  double left_, width_, uneven_;
};

// The edge length h of equilateral triangles. Each has the area √3/4 h², and there are two per
// inner vertex, but fewer per vertex of the boundary.
double edge_length(const Region& region, int vertices) {
  const double inside = area(region) * 2 / std::sqrt(3.0), rim = perimeter(region) / 2;
  return (rim + std::sqrt(rim * rim + 4 * vertices * inside)) / (2 * vertices);
}

// The inverse: the number of vertices with which edges have the given length.
double vertices_with(const Region& region, double length) {
  const double inside = area(region) * 2 / std::sqrt(3.0), rim = perimeter(region) / 2;
  return inside / (length * length) + rim / length;
}

// Triangulates one region with edges of any length.
class Mesher {
 public:
  Mesher(const Region& region, const TriangulationOptions& options, const std::string& name)
      : region_(region), lengths_(region, options.uneven), options_(options), name_(name) {}

  // Edges are first so long that a few vertices are missing. Those are added, except as many as the
  // repair of angles after the relaxation added in the last try.
  Triangulation run() const {
    const double length = coarse_length();
    int least = options_.vertices;
    Triangulation best = meshed(length, kPasses, least);
    int last = static_cast<int>(best.V.cols());
    for (int i = 1; i < kMostTries && off(best) > options_.vertices / 100; ++i) {
      if (off(best) > options_.vertices / 3) break;  // the boundary needs more vertices
      least -= last - options_.vertices;
      Triangulation next = meshed(length, kPasses, least);
      last = static_cast<int>(next.V.cols());
      if (off(next) < off(best)) best = std::move(next);
    }
    return best;
  }

 private:
  int off(const Triangulation& mesh) const {
    return std::abs(static_cast<int>(mesh.V.cols()) - options_.vertices);
  }

  double coarse_length() const {
    const double first = edge_length(region_, options_.vertices);
    double length = first, best = first;
    int least_off = std::numeric_limits<int>::max();
    for (int i = 0; i < kMostTries; ++i) {
      const Triangulation mesh = meshed(length, 0, 0);
      if (off(mesh) < least_off) least_off = off(mesh), best = length;
      const double share = static_cast<double>(mesh.V.cols()) / options_.vertices;
      if (share > kFew && share <= 1) return length;
      const double next =
          std::min(length * std::sqrt(2 * share / (kFew + 1)), kMostStretch * first);
      if (next == length) break;  // as long as edges may be: the boundary needs more vertices
      length = next;
    }
    return best;
  }

  Triangulation meshed(double length, int passes, int least) const {
    const Spacing spacing = lengths_.spacing(length);
    const int most = 2 * std::max(options_.vertices, 50000);
    const Region sampled = resampled(region_, spacing);
    check_apart(sampled);
    auto mesh = delaunay_mesh(sampled, spacing, {passes, least, most});
    if (mesh) return *std::move(mesh);
    cannot_use(name_,
               fmt::format("its parts are so thin that good triangles would have more than {} "
                           "vertices; make them thicker or leave them out",
                           most));
  }

  // Computations with triangles lose more digits, the thinner the triangles are.
  void check_apart(const Region& region) const {
    Polygons polygons{region.outline};
    polygons.insert(polygons.end(), region.holes.begin(), region.holes.end());
    const double least = kLeastDetail * region.outline.cwiseAbs().maxCoeff();
    const auto corner = corner_near_edge(polygons, least);
    if (!corner) return;
    const Eigen::Vector2d place = polygons[corner->polygon].col(corner->corner);
    cannot_use(name_, fmt::format("at ({:g}, {:g}) its boundary is less than {:g} from itself, a "
                                  "billionth of the greatest coordinate; leave such detail out, or "
                                  "move it all to the origin",
                                  place[0], place[1], least));
  }

  const Region& region_;
  Lengths lengths_;
  const TriangulationOptions& options_;
  const std::string& name_;
};

}  // namespace

int suited_vertices(const Region& region) {
  const double width = 2 * area(region) / perimeter(region);  // of a long limb
  const double vertices = vertices_with(region, width);
  return static_cast<int>(std::clamp(vertices, kFewestSuited, kMostSuited));
}

Triangulation triangulate(const Region& region, const TriangulationOptions& options,
                          const std::string& name) {
  check_options(options);
  if (options.vertices == 1 || options.vertices == 2) {
    throw OptionError("vertices", std::to_string(options.vertices), "; allowed: 0, or 3 to 200000");
  }
  const Region clean = checked(region, name);
  TriangulationOptions complete = options;
  if (complete.vertices == 0) complete.vertices = suited_vertices(clean);
  return Mesher(clean, complete, name).run();
}

}  // namespace deformlab
