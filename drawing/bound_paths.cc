#include "drawing/bound_paths.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "drawing/cut_sides.h"

namespace deformlab {
namespace {

template <class Path, class Visit>
void for_each_matrix(Path& path, Visit&& visit) {
  for (auto& curve : path.outlines.curves) visit(curve.points);
  for (auto& clip : path.clips)
    for (auto& curve : clip.curves) visit(curve.points);
}

Eigen::Matrix2Xd all_points(const std::vector<VectorPath>& paths) {
  Eigen::Index count = 0;
  for (const VectorPath& path : paths)
    for_each_matrix(path, [&](const Eigen::Matrix2Xd& points) { count += points.cols(); });
  Eigen::Matrix2Xd all(2, count);
  Eigen::Index at = 0;
  for (const VectorPath& path : paths)
    for_each_matrix(path, [&](const Eigen::Matrix2Xd& points) {
      all.middleCols(at, points.cols()) = points;
      at += points.cols();
    });
  return all;
}

Eigen::Matrix2Xd outline_points(const VectorPath& path) {
  VectorPath outlines;
  outlines.outlines = path.outlines;
  return all_points({outlines});
}

}  // namespace

BoundPaths::BoundPaths(std::vector<VectorPath> paths, const Triangulation& rest,
                       const Locator& locator, const CutLines& cuts)
    : rest_(std::move(paths)) {
  const Eigen::Matrix2Xd points = all_points(rest_);
  points_ = Binding(rest, locator, points, places_beside(cuts, points, rest, locator));
}

std::vector<VectorPath> BoundPaths::operator()(const Eigen::Matrix2Xd& V) const {
  const Eigen::Matrix2Xd moved = points_(V);
  std::vector<VectorPath> paths = rest_;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    VectorPath& path = paths[i];
    for_each_matrix(path, [&](Eigen::Matrix2Xd& points) {
      points = moved.middleCols(at, points.cols());
      at += points.cols();
    });
    if (path.fill.points.size() == 0 && path.stroke.points.size() == 0) continue;
    const Eigen::Affine2d map = fitted_map(outline_points(rest_[i]), outline_points(path));
    for (Paint* paint : {&path.fill, &path.stroke})
      if (paint->points.size() > 0) paint->points = map * paint->points;
  }
  return paths;
}

Eigen::Affine2d fitted_map(const Eigen::Matrix2Xd& from, const Eigen::Matrix2Xd& to) {
  constexpr double kFlat = 1e-6;  // points lie on a line if the ratio of eigenvalues is smaller
  const Eigen::Vector2d c = from.rowwise().mean(), d = to.rowwise().mean();
  const Eigen::Matrix2Xd p = from.colwise() - c, q = to.colwise() - d;
  const Eigen::Matrix2d spread = p * p.transpose(), cross = q * p.transpose();
  const Eigen::Vector2d sizes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread, Eigen::EigenvaluesOnly).eigenvalues();
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
  if (sizes[0] > kFlat * sizes[1]) {
    A = cross * spread.inverse();
  } else if (sizes[1] > 0) {
    const double x = cross.trace() / spread.trace();
    const double y = (cross(1, 0) - cross(0, 1)) / spread.trace();
    A << x, -y, y, x;
  }
  Eigen::Affine2d map;
  map.linear() = A;
  map.translation() = d - A * c;
  map.makeAffine();
  return map;
}

}  // namespace deformlab
