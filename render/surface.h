#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "geometry/shape/shape.h"
#include "render/camera.h"
#include "render/ray_scene.h"

namespace deformlab {

/// What shading needs to know about a point of a surface.
struct SurfacePoint {
  Eigen::Vector3f normal;  ///< unit, on the side that the ray comes from
  Eigen::Vector3f color;   ///< linear, not sRGB
  float openness;          ///< 1 minus the ambient occlusion
};

/// A shape prepared for rays, in the framed coordinates of a view. Both sides of a face are
/// visible, because triangle soups and open sheets have no orientation. If no triangle has an area,
/// the vertices are drawn as balls.
class Surface {
 public:
  /// `shape` may be null; `colors` is 3×#V sRGB or 3×0.
  Surface(const Shape* shape, const Eigen::Matrix3Xd& colors, const View& view);

  const RayScene& scene() const { return scene_; }
  SurfacePoint at(const Hit& hit, const Eigen::Vector3f& ray) const;

 private:
  void add_dots(const Shape& framed, const View& view);
  SurfacePoint dot_at(const Hit& hit, const Eigen::Vector3f& ray,
                      const Eigen::Vector3f& face) const;
  float openness(int vertex, bool back) const;
  float measure_openness(int vertex, bool back) const;

  RayScene scene_;
  Eigen::Matrix3Xf V_, N_, colors_;
  Eigen::Matrix3Xi triangles_;   // 3×0 if the vertices are drawn as balls
  Eigen::Matrix3Xf directions_;  // in which occluders are searched
  bool has_normals_ = true;      // false: dots are shaded as balls, and N_ points to the eye
  float clearance_ = 0;          // distance above a vertex where the search for occluders begins

  // The openness of the front and the back of every vertex, negative until it is needed. Threads
  // that compute the same entry get the same value, so it does not matter which one writes last.
  mutable std::vector<std::atomic<float>> openness_;
};

}  // namespace deformlab
