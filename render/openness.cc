#include "render/openness.h"

#include <algorithm>
#include <cmath>

#include "geometry/core/workers.h"

namespace deformlab {
namespace {

constexpr int kSpacing = 4;               // of the lattice [pixel]
constexpr float kSlope = 0.3F;            // by which a point may leave the plane of another one
constexpr float kAlikeNormals = 0.6F;     // the least cosine between normals
constexpr float kLeastAlikeness = 0.01F;  // of the four points together

}  // namespace

OpennessLattice::OpennessLattice(const Surface& surface, const View& view, int width, int height,
                                 int threads)
    : surface_(surface),
      columns_((width - 1) / kSpacing + 2),
      rows_((height - 1) / kSpacing + 2),
      known_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  const Eigen::Vector3f eye = view.eye.cast<float>();
  Workers(threads).each(rows_, [&](int row) {
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector3f ray =
          view.ray(double(kSpacing * column) / width, double(kSpacing * row) / height);
      const auto hit = surface.scene().first_hit(eye, ray);
      if (!hit) continue;
      const SurfacePoint point = surface.at(*hit, eye, ray);
      known_[static_cast<std::size_t>(row) * columns_ + column] = {point, surface.openness(point)};
    }
  });
}

// 0 for points on different parts of the surface, up to 1 for those in one plane.
float OpennessLattice::alikeness(const SurfacePoint& a, const SurfacePoint& b) const {
  const float cosine = a.normal.dot(b.normal);
  const Eigen::Vector3f way = a.place - b.place;
  const float off = std::max(std::abs(way.dot(a.face)), std::abs(way.dot(b.face)));
  const bool same = off <= kSlope * way.norm() + 2 * surface_.clearance();
  return same ? std::max(0.0F, (cosine - kAlikeNormals) / (1 - kAlikeNormals)) : 0;
}

float OpennessLattice::at(double x, double y, const SurfacePoint& point) const {
  const int column = std::clamp(static_cast<int>(x) / kSpacing, 0, columns_ - 2);
  const int row = std::clamp(static_cast<int>(y) / kSpacing, 0, rows_ - 2);
  const auto s = static_cast<float>(x / kSpacing - column);
  const auto t = static_cast<float>(y / kSpacing - row);
  float sum = 0, weights = 0;
  for (int i = 0; i < 4; ++i) {
    const std::optional<Known>& near = known(column + i % 2, row + i / 2);
    if (!near) continue;
    const float weight = (i % 2 ? s : 1 - s) * (i / 2 ? t : 1 - t) * alikeness(point, near->point);
    sum += weight * near->openness;
    weights += weight;
  }
  return weights > kLeastAlikeness ? sum / weights : surface_.openness(point);
}

}  // namespace deformlab
