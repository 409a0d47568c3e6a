#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace deformlab {

/// The first intersection of a ray.
struct Hit {
  float distance;          ///< in lengths of the ray's direction
  Eigen::Vector3f normal;  ///< of the surface, with any length and orientation
  int object;              ///< the number of the call of add_… that added it, counted from 0
  int element;             ///< its column in that call
  float u, v;              ///< weights of a triangle's second and third corner
};

/// Finds where rays hit triangles, balls and sticks, with Embree. Coordinates should be of the
/// order of 1, because they have single precision. Objects without area are never hit.
class RayScene {
 public:
  RayScene();
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  void add_triangles(const Eigen::Matrix3Xf& V, const Eigen::Matrix3Xi& triangles);
  /// `balls` is 4×n, with a centre and a radius in each column.
  void add_balls(const Eigen::Matrix4Xf& balls);
  /// `ends` is 4×2n: two columns are the ends (point and radius) of a stick with round caps.
  void add_sticks(const Eigen::Matrix4Xf& ends);
  void commit();  ///< has to be called once, after all objects are added and before the first ray

  std::optional<Hit> first_hit(const Eigen::Vector3f& origin,
                               const Eigen::Vector3f& direction) const;
  bool blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float until) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace deformlab
