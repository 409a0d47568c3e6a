#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "geometry/shape/shape.h"
#include "render/camera.h"
#include "render/ray_scene.h"

namespace deformlab {

/// What the lights need to know of a place on a surface.
struct SurfacePoint {
  Eigen::Vector3f normal;  ///< unit, on the side that the ray comes from
  Eigen::Vector3f color;   ///< linear, not sRGB
  float openness;          ///< 1 less the ambient occlusion
};

/// A shape made ready to be looked at, in the view's framed coordinates. Both sides of a face show:
/// soups and open sheets have no orientation. Where no triangle has an area the vertices are balls.
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
  Eigen::Matrix3Xi triangles_;   // 3×0: the vertices are drawn as balls
  Eigen::Matrix3Xf directions_;  // where occluders are looked for
  bool has_normals_ = true;      // else dots are shaded as balls, and N_ points to the eye
  float clearance_ = 0;          // how far above a vertex that begins

  // Front and back of every vertex, negative until somebody looks at it. Threads that meet at a
  // vertex find the same number, so it does not matter whose stays.
  mutable std::vector<std::atomic<float>> openness_;
};

}  // namespace deformlab
