#include <algorithm>
#include <cmath>
#include <sstream>

#include "geometry/boundary_sampling.h"
#include "geometry/delaunay_mesh.h"
#include "geometry/error.h"
#include "geometry/triangulation.h"

namespace deformlab {
namespace {

constexpr int kFewest = 3, kMost = 200000;
constexpr double kMostUneven = 10;
constexpr double kBlend = 0.1;  // share of the width on either side of the middle where edges grow

[[noreturn]] void reject(const char* option, double value, double least, double most) {
  std::ostringstream what;
  what << option << " of the mesh is " << value << "; it must be " << least << " to " << most;
  throw InputError(what.str());
}

void check(const TriangulationOptions& options) {
  if (options.vertices < kFewest || options.vertices > kMost) {
    reject("vertices", options.vertices, kFewest, kMost);
  }
  if (!(options.uneven >= 1 / kMostUneven && options.uneven <= kMostUneven)) {
    reject("uneven", options.uneven, 1 / kMostUneven, kMostUneven);
  }
}

// A region and how the length of its edges varies.
class Sizes {
 public:
  Sizes(const Region& region, double uneven)
      : left_(region.outline.row(0).minCoeff()),
        width_(region.outline.row(0).maxCoeff() - left_),
        uneven_(uneven) {}

  Spacing spacing(double length) const {
    if (uneven_ == 1) return [length](const Eigen::Vector2d&) { return length; };
    return [*this, length](const Eigen::Vector2d& place) {
      const double from_middle = (place[0] - left_) / width_ - 0.5;
      const double t = std::clamp(from_middle / kBlend, -1.0, 1.0);
      return length * std::pow(uneven_, (t + 1) / 2);
    };
  }

 private:
  double left_, width_, uneven_;
};

Triangulation meshed(const Region& region, const Spacing& spacing, int passes) {
  return delaunay_mesh(resampled(region, spacing), spacing, passes);
}

// Equilateral triangles of that edge: each of area √3/4 h², two a vertex but for those on the rim.
double edge_length(const Region& region, int vertices) {
  const double inside = area(region) * 2 / std::sqrt(3.0), rim = perimeter(region) / 2;
  return (rim + std::sqrt(rim * rim + 4 * vertices * inside)) / (2 * vertices);
}

}  // namespace

Triangulation triangulate(const Region& region, const TriangulationOptions& options,
                          const std::string& name) {
  check(options);
  const Region clean = checked(region, name);
  const Sizes sizes(clean, options.uneven);
  return meshed(clean, sizes.spacing(edge_length(clean, options.vertices)), 40);
}

}  // namespace deformlab
