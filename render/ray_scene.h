#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace deformlab {

/// The first intersection of a ray.
struct Hit {
  float distance;          ///< in lengths of the ray's direction
  Eigen::Vector3f normal;  ///< of the surface there, any length and orientation
  int object;              ///< the number of the add_ call that added it, counted from 0
  int element;             ///< the column of that call
  float u, v;              ///< weights of a triangle's second and third corner
};

/// Triangles, balls and sticks that rays are shot at (Embree). Single precision: coordinates should
/// be of the order of one. What has no extent (a zero-area triangle, a zero radius) is never hit.
class RayScene {
 public:
  RayScene();
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  void add_triangles(const Eigen::Matrix3Xf& V, const Eigen::Matrix3Xi& triangles);
  /// 4×#balls: centre and radius.
  void add_balls(const Eigen::Matrix4Xf& balls);
  /// 4×2n: each two columns are the ends of a stick with round caps, point and radius.
  void add_sticks(const Eigen::Matrix4Xf& ends);
  void commit();  ///< to be called once, after everything is added and before the first ray

  std::optional<Hit> first_hit(const Eigen::Vector3f& origin,
                               const Eigen::Vector3f& direction) const;
  bool blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float until) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace deformlab
