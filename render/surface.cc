#include "render/surface.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "geometry/core/error.h"
#include "geometry/core/median.h"
#include "render/color.h"

namespace deformlab {
namespace {

constexpr int kDirections = 128;        // over the sphere; half of them are above a point
constexpr float kReach = 0.30F;         // the largest distance of occluders [framed coordinates]
constexpr float kClearance = 1e-3F;     // [framed coordinates]
constexpr float kSmoothCosine = 0.62F;  // below it, a corner's normal differs too much: a crease
constexpr double kSmallestDot = 7e-4, kLargestDot = 0.02, kDotPerSpacing = 1.3;

/// Directions that the golden angle spreads evenly over the sphere. Every point uses the same ones,
/// so that occlusion varies smoothly along the surface, without noise.
Eigen::Matrix3Xf sphere_directions() {
  Eigen::Matrix3Xf D(3, kDirections);
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.0) / kDirections, r = std::sqrt(1 - z * z);
    D.col(i) = Eigen::Vector3d(r * std::cos(turn * i), r * std::sin(turn * i), z).cast<float>();
  }
  return D;
}

/// The median distance from a point to the nearest one at another position; 0 if there is none.
double typical_spacing(const Eigen::Matrix3Xd& P) {
  using Tree =
      nanoflann::KDTreeEigenMatrixAdaptor<Eigen::Matrix3Xd, 3, nanoflann::metric_L2_Simple, false>;
  const Tree tree(3, P);
  constexpr std::size_t kNeighbors = 4;  // itself, and a few in case of repeated points
  std::vector<double> spacings;
  for (Eigen::Index i = 0; i < P.cols(); ++i) {
    Eigen::Index indices[kNeighbors];
    double squared[kNeighbors];
    const std::size_t found = tree.index->knnSearch(P.col(i).data(), kNeighbors, indices, squared);
    const double* nearest = std::find_if(squared, squared + found, [](double d) { return d > 0; });
    if (nearest != squared + found) spacings.push_back(std::sqrt(*nearest));
  }
  if (spacings.empty()) return 0;
  return median(std::move(spacings));
}

bool any_area(const Eigen::Matrix3Xd& P, const Eigen::Matrix3Xi& triangles) {
  for (const auto& t : triangles.colwise()) {
    const Eigen::Vector3d a = P.col(t(1)) - P.col(t(0)), b = P.col(t(2)) - P.col(t(0));
    if (a.cross(b).squaredNorm() > 0) return true;
  }
  return false;
}

Eigen::Matrix3Xf linear_colors(const Eigen::Matrix3Xd& colors, Eigen::Index count) {
  if (colors.cols() != 0 && colors.cols() != count)
    throw InputError(
        fmt::format("cannot colour {} vertices with {} colours: give one for each vertex, or none",
                    count, colors.cols()));
  if (!colors.allFinite()) throw InputError("cannot draw vertex colours that are not finite");
  Eigen::Matrix3Xf linear(3, count);
  if (colors.cols() == 0) return linear.colwise() = to_linear(colors::kSurface), linear;
  for (Eigen::Index i = 0; i < count; ++i) linear.col(i) = to_linear(colors.col(i));
  return linear;
}

}  // namespace

Surface::Surface(const Shape* shape, const Eigen::Matrix3Xd& colors, const View& view)
    : directions_(sphere_directions()) {
  if (shape) {
    check(*shape, "the shape to draw");
    const Shape framed{view.framed(shape->V), shape->N, shape->faces};
    colors_ = linear_colors(colors, shape->V.cols());
    V_ = framed.V.cast<float>();
    triangles_ = triangles(framed);
    if (any_area(framed.V, triangles_)) {
      N_ = vertex_normals(framed).cast<float>();
      clearance_ = kClearance;
      scene_.add_triangles(V_, triangles_);
    } else {
      add_dots(framed, view);
    }
  }
  scene_.commit();
}

void Surface::add_dots(const Shape& framed, const View& view) {
  triangles_.resize(3, 0);
  const double spacing = typical_spacing(framed.V);
  const double radius =
      spacing > 0 ? std::clamp(kDotPerSpacing * spacing, kSmallestDot, kLargestDot) : kLargestDot;
  Eigen::Matrix4Xf balls(4, V_.cols());
  balls << V_, Eigen::RowVectorXf::Constant(V_.cols(), static_cast<float>(radius));
  scene_.add_balls(balls);
  clearance_ = static_cast<float>(1.5 * radius);
  has_normals_ = framed.N.cols() == V_.cols();
  if (has_normals_) N_ = framed.N.cast<float>();
  if (!has_normals_) N_ = (-V_).colwise() + view.eye.cast<float>();
  N_.colwise().normalize();
}

SurfacePoint Surface::at(const Hit& hit, const Eigen::Vector3f& eye,
                         const Eigen::Vector3f& ray) const {
  Eigen::Vector3f face = hit.normal.stableNormalized();
  if (face.dot(ray) > 0) face = -face;
  if (triangles_.cols() == 0) return dot_at(hit, ray, face);
  const float weights[] = {1 - hit.u - hit.v, hit.u, hit.v};
  SurfacePoint point{eye + hit.distance * ray, Eigen::Vector3f::Zero(), face,
                     Eigen::Vector3f::Zero()};
  for (int c = 0; c < 3; ++c) {
    const int vertex = triangles_(c, hit.element);
    const float cosine = N_.col(vertex).dot(face);
    const float side = cosine < 0 ? -1.0F : 1.0F;
    const bool smooth = std::abs(cosine) >= kSmoothCosine;
    point.normal += weights[c] * (smooth ? Eigen::Vector3f(side * N_.col(vertex)) : face);
    point.color += weights[c] * colors_.col(vertex);
  }
  point.normal.normalize();
  return point;
}

SurfacePoint Surface::dot_at(const Hit& hit, const Eigen::Vector3f& ray,
                             const Eigen::Vector3f& face) const {
  const Eigen::Vector3f normal = N_.col(hit.element);
  const Eigen::Vector3f front = normal.dot(ray) > 0 ? Eigen::Vector3f(-normal) : normal;
  const bool shades = has_normals_ && !normal.isZero();
  return {V_.col(hit.element), shades ? front : face, front, colors_.col(hit.element)};
}

// Directions below the face, where a smooth normal leans over, are left out, because the face
// itself would occlude them.
float Surface::openness(const SurfacePoint& point) const {
  const Eigen::Vector3f start = point.place + clearance_ * point.face;
  float open = 0, all = 0;
  for (const auto& direction : directions_.colwise()) {
    const float cosine = point.normal.dot(direction);
    if (cosine <= 0 || point.face.dot(direction) <= 0) continue;
    all += cosine;
    if (!scene_.blocked(start, direction, kReach)) open += cosine;
  }
  return all > 0 ? open / all : 1;
}

}  // namespace deformlab
