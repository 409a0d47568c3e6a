#include "render/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace deformlab {
namespace {

/// Copies `values`, a column for each element. Embree reads beyond the end of a buffer, so it
/// allocates the memory itself, with padding.
template <class Derived>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
          const Eigen::PlainObjectBase<Derived>& values) {
  using Scalar = typename Derived::Scalar;
  if (values.size() == 0) return;
  auto* buffer = static_cast<Scalar*>(rtcSetNewGeometryBuffer(
      geometry, type, 0, format, static_cast<std::size_t>(values.rows()) * sizeof(Scalar),
      static_cast<std::size_t>(values.cols())));
  if (!buffer) throw std::runtime_error("Embree has no memory left for the picture's geometry");
  std::copy_n(values.data(), values.size(), buffer);
}

template <class Ray>
void aim(Ray& ray, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float until) {
  ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tnear = 0;
  ray.tfar = until;
  ray.time = 0;
  ray.mask = std::numeric_limits<unsigned>::max();
  ray.flags = 0;
}

}  // namespace

struct RayScene::Embree {
  // With several threads, the tree varies from run to run, and so does the result of a tie.
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = device ? rtcNewScene(device) : nullptr;

  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  /// An empty geometry is not attached, but it takes a number too.
  void attach(RTCGeometry geometry, bool empty) {
    if (!empty) {
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(scene, geometry, objects);
    }
    rtcReleaseGeometry(geometry);
    ++objects;
  }

  unsigned objects = 0;
};

RayScene::RayScene() : embree_(std::make_unique<Embree>()) {
  if (!embree_->scene) throw std::runtime_error("Embree cannot start");
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
}

RayScene::~RayScene() = default;

void RayScene::add_triangles(const Eigen::Matrix3Xf& V, const Eigen::Matrix3Xi& triangles) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, V);
  fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  embree_->attach(geometry, triangles.size() == 0);
}

void RayScene::add_balls(const Eigen::Matrix4Xf& balls) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, balls);
  embree_->attach(geometry, balls.size() == 0);
}

void RayScene::add_sticks(const Eigen::Matrix4Xf& ends) {
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, ends);
  const auto count = ends.cols() / 2;
  const Eigen::RowVectorXi starts = 2 * Eigen::RowVectorXi::LinSpaced(count, 0, int(count) - 1);
  fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, starts);
  embree_->attach(geometry, count == 0);
}

void RayScene::commit() { rtcCommitScene(embree_->scene); }

std::optional<Hit> RayScene::first_hit(const Eigen::Vector3f& origin,
                                       const Eigen::Vector3f& direction) const {
  RTCRayHit ray;
  aim(ray.ray, origin, direction, std::numeric_limits<float>::infinity());
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{ray.ray.tfar,
             {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z},
             static_cast<int>(ray.hit.geomID),
             static_cast<int>(ray.hit.primID),
             ray.hit.u,
             ray.hit.v};
}

bool RayScene::blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                       float until) const {
  RTCRay ray;
  aim(ray, origin, direction, until);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace deformlab
