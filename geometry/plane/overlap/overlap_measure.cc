#include "geometry/plane/overlap/overlap_measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/core/error.h"
#include "geometry/plane/cross.h"
#include "geometry/plane/overlap/overlap_triangles.h"

namespace deformlab {
namespace {

// A triangle with a depth at each corner. The depth is linear in between.
struct Slope {
  TurnedTriangle triangle;
  Eigen::Vector3d depth;

  Slope(const Triangulation& mesh, const Eigen::Matrix3Xd& depths, int t)
      : triangle{mesh.V(Eigen::all, mesh.F.col(t)), 0}, depth(depths.col(t)) {
    const auto& c = triangle.corners;
    triangle.turn = turn(c.col(0), c.col(1), c.col(2));
  }

  // The result is in the range of the corners' depths, however thin the triangle is.
  double at(const Eigen::Vector2d& place) const {
    Eigen::Vector3d b;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d u = triangle.corners.col((k + 1) % 3) - place;
      b[k] = std::max(0.0, triangle.turn * cross(u, triangle.corners.col((k + 2) % 3) - place));
    }
    const double sum = b.sum();
    return sum > 0 ? b.dot(depth) / sum : depth.mean();
  }
};

// The area where `a` is in front of `b`. `both` is the area that both cover.
double area_in_front(const Slope& a, const Slope& b, double both) {
  const double a_least = a.depth.minCoeff(), a_most = a.depth.maxCoeff();
  const double b_least = b.depth.minCoeff(), b_most = b.depth.maxCoeff();
  if (a_least == b_most && a_most == b_least) return both / 2;
  if (a_least >= b_most) return both;
  if (a_most <= b_least) return 0;
  const ConvexPolygon polygon = intersection(a.triangle, b.triangle);
  ConvexPolygonValues difference(polygon.cols());
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    difference[i] = a.at(polygon.col(i)) - b.at(polygon.col(i));
  }
  if (polygon.cols() == 0 || difference.isZero(0)) return both / 2;
  if (difference.minCoeff() >= 0) return both;
  if (difference.maxCoeff() <= 0) return 0;
  return std::min(both, convex_area(clipped(polygon, difference)));
}

}  // namespace

Eigen::Matrix3Xd vertex_depths(const Eigen::Matrix3Xi& F, const Eigen::VectorXd& depth) {
  if (F.size() > 0 && (F.minCoeff() < 0 || F.maxCoeff() >= depth.size())) {
    throw InputError(
        fmt::format("there are depths of {} vertices; triangles name vertices {} to {}",
                    depth.size(), F.minCoeff(), F.maxCoeff()));
  }
  Eigen::Matrix3Xd result(3, F.cols());
  result.reshaped() = depth(F.reshaped());
  return result;
}

Eigen::Matrix3Xd triangle_depths(const Eigen::VectorXd& depth) {
  return depth.transpose().replicate<3, 1>();
}

Interpenetration interpenetration(const Triangulation& deformed, const Overlaps& overlaps,
                                  const Eigen::Matrix3Xd& depth) {
  if (depth.cols() != deformed.F.cols() || !depth.allFinite()) {
    throw InputError(
        fmt::format("depths of {} triangles cannot be measured on {}; each triangle needs three "
                    "that are finite",
                    depth.cols(), deformed.F.cols()));
  }
  Interpenetration result;
  for (const OverlapRegion& region : overlaps.regions) {
    double first = 0, second = 0;  // area where this sheet is in front
    for (const TrianglePair& pair : overlaps.pairs_of(region)) {
      const Slope a(deformed, depth, pair.a), b(deformed, depth, pair.b);
      const double in_front = area_in_front(a, b, pair.area);
      first += in_front;
      second += pair.area - in_front;
    }
    const double wrong = std::min(first, second);
    result.overlap += region.area;
    result.area += wrong;
    if (wrong > 0) result.worst = std::max(result.worst, wrong / (first + second));
  }
  return result;
}

}  // namespace deformlab
