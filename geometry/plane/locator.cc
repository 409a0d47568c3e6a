#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost itself includes one, and warns about it

#include "geometry/plane/locator.h"

#include <algorithm>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <limits>
#include <sstream>
#include <vector>

#include "geometry/core/error.h"
#include "geometry/plane/cross.h"

namespace deformlab {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Entry = std::pair<Box, int>;
using Corners = Eigen::Matrix<double, 2, 3>;

constexpr double kRounding = 1e-12;  // relative to the greatest coordinate

Corners corners(const Triangulation& mesh, Eigen::Index triangle) {
  return mesh.V(Eigen::all, mesh.F.col(triangle));
}

Box box(const Corners& triangle) {
  const Eigen::Vector2d low = triangle.rowwise().minCoeff(), high = triangle.rowwise().maxCoeff();
  return {{low[0], low[1]}, {high[0], high[1]}};
}

// Barycentric coordinates of the point on the edge from corner k that is nearest to a given point.
Eigen::Vector3d nearest_on_edge(const Corners& triangle, int k, const Eigen::Vector2d& point) {
  const int next = (k + 1) % 3;
  const Eigen::Vector2d along = triangle.col(next) - triangle.col(k);
  const double t = (point - triangle.col(k)).dot(along) / along.squaredNorm();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  b[next] = std::clamp(t, 0.0, 1.0);
  b[k] = 1 - b[next];
  return b;
}

// Barycentric coordinates of the point in the triangle that is nearest to a given point.
Eigen::Vector3d nearest_inside(const Corners& triangle, const Eigen::Vector2d& point) {
  Eigen::Vector3d b;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d u = triangle.col((k + 1) % 3) - point;
    b[k] = cross(u, triangle.col((k + 2) % 3) - point);
  }
  if (b.minCoeff() >= 0) return b / b.sum();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d candidate = nearest_on_edge(triangle, k, point);
    const double distance = (triangle * candidate - point).squaredNorm();
    if (distance < least) least = distance, b = candidate;
  }
  return b;
}

}  // namespace

struct Locator::Tree {
  std::vector<Corners> triangles;
  double rounding;  // distances up to this count as 0 [length]
  bg::index::rtree<Entry, bg::index::rstar<8>> boxes;

  void try_triangle(int t, const Eigen::Vector2d& point, Located& best) const;
};

void Locator::Tree::try_triangle(int t, const Eigen::Vector2d& point, Located& best) const {
  const Eigen::Vector3d b = nearest_inside(triangles[t], point);
  const Eigen::Vector2d nearest = triangles[t] * b;
  double distance = (nearest - point).norm();
  if (distance <= rounding) distance = 0;
  const bool first = t < best.triangle;
  if (distance > best.distance || (distance == best.distance && !first)) return;
  best = {t, b, distance == 0 ? point : nearest, distance};
}

Locator::Locator(const Triangulation& mesh) : tree_(std::make_unique<Tree>()) {
  check(mesh);
  if (mesh.F.cols() == 0) throw InputError("there is no triangle to find a place in");
  std::vector<Entry> entries;
  for (Eigen::Index t = 0; t < mesh.F.cols(); ++t) {
    tree_->triangles.push_back(corners(mesh, t));
    entries.emplace_back(box(tree_->triangles.back()), static_cast<int>(t));
  }
  tree_->rounding = kRounding * mesh.V.cwiseAbs().maxCoeff();
  tree_->boxes = decltype(tree_->boxes)(entries);
}

Locator::~Locator() = default;
Locator::Locator(Locator&&) noexcept = default;

Located Locator::operator()(const Eigen::Vector2d& point) const {
  if (!point.allFinite()) {
    std::ostringstream what;
    what << "a place is (" << point[0] << ", " << point[1] << "); both numbers must be finite";
    throw InputError(what.str());
  }
  const Point query(point[0], point[1]);
  Located result{-1, {}, {}, std::numeric_limits<double>::infinity()};
  std::vector<Entry> near;
  double reach = 0;  // all boxes that are nearer than this are in `near`
  for (unsigned count = 8; reach <= result.distance && near.size() < tree_->boxes.size();
       count *= 4) {
    near.clear();
    tree_->boxes.query(bg::index::nearest(query, count), std::back_inserter(near));
    for (const auto& [box, triangle] : near) {
      tree_->try_triangle(triangle, point, result);
      reach = std::max(reach, bg::distance(query, box));
    }
  }
  return result;
}

}  // namespace deformlab
