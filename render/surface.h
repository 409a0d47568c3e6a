#pragma once

#include <Eigen/Core>

#include "geometry/shape/shape.h"
#include "render/camera.h"
#include "render/ray_scene.h"

namespace deformlab {

/// What shading needs to know about a point of a surface, in framed coordinates.
struct SurfacePoint {
  Eigen::Vector3f place;   ///< on a face; the centre of a ball
  Eigen::Vector3f normal;  ///< unit, on the side that the ray comes from, smooth between faces
  Eigen::Vector3f face;    ///< unit, the normal of the face or of the ball
  Eigen::Vector3f color;   ///< linear, not sRGB
};

/// A shape prepared for rays, in the framed coordinates of a view. Both sides of a face are
/// visible, because triangle soups and open sheets have no orientation. If no triangle has an area,
/// the vertices are drawn as balls.
class Surface {
 public:
  /// `shape` may be null; `colors` is 3×#V sRGB or 3×0.
  Surface(const Shape* shape, const Eigen::Matrix3Xd& colors, const View& view);

  const RayScene& scene() const { return scene_; }

  /// The point that a ray from the eye has hit.
  SurfacePoint at(const Hit& hit, const Eigen::Vector3f& eye, const Eigen::Vector3f& ray) const;

  /// 1 minus the ambient occlusion: how much of the light from all sides reaches a point. It
  /// varies smoothly along the surface, without noise.
  float openness(const SurfacePoint& point) const;

  /// The distance from a point at which the search for occluders begins.
  float clearance() const { return clearance_; }

 private:
  void add_dots(const Shape& framed, const View& view);
  SurfacePoint dot_at(const Hit& hit, const Eigen::Vector3f& ray,
                      const Eigen::Vector3f& face) const;

  RayScene scene_;
  Eigen::Matrix3Xf V_, N_, colors_;
  Eigen::Matrix3Xi triangles_;   // 3×0 if the vertices are drawn as balls
  Eigen::Matrix3Xf directions_;  // in which occluders are searched
  bool has_normals_ = true;      // false: dots are shaded as balls, and N_ points to the eye
  float clearance_ = 0;
};

}  // namespace deformlab
