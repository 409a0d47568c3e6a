#include "render/camera.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/core/error.h"

namespace deformlab {
namespace {

constexpr double kNearest = 0.2;  // least depth of a point [framed coordinates]

void set_directions(const Camera& camera, View& view) {
  if (!(camera.direction.norm() > 0) || !camera.direction.allFinite())
    throw InputError("cannot point the camera: its direction must be finite and not zero");
  view.forward = camera.direction.normalized();
  const Eigen::Vector3d right = view.forward.cross(camera.up.normalized());
  if (!(right.norm() > 1e-9))
    throw InputError("cannot point the camera: its direction must not be parallel to its up");
  view.right = right.normalized();
  view.up = view.right.cross(view.forward);
}

void set_opening(const Camera& camera, int width, int height, View& view) {
  if (!(camera.field_of_view > 0 && camera.field_of_view < 180))
    throw InputError(
        fmt::format("cannot use a field of view of {} degrees: it must lie between 0 and 180",
                    camera.field_of_view));
  if (!(camera.margin >= 0 && camera.margin < 0.5))
    throw InputError(fmt::format(
        "cannot leave a margin of {} of the picture: it must lie in [0, 0.5)", camera.margin));
  view.tan_y = std::tan(camera.field_of_view * std::numbers::pi / 360);
  view.tan_x = view.tan_y * width / height;
}

void set_origin(const Eigen::Matrix3Xd& points, View& view) {
  view.center = Eigen::Vector3d::Zero();
  view.size = 1;
  if (points.cols() == 0) return;
  if (!points.allFinite()) throw InputError("cannot draw points that are not finite");
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  view.center = low / 2 + high / 2;
  if (high != low) view.size = (high - low).stableNorm();
  if (!std::isfinite(view.size)) throw InputError("cannot draw points: they lie too far apart");
}

/// How far the eye must move back, and aside along one axis of the picture, so that all points lie
/// between the two planes through the eye that have the slope `tangent`.
struct Fit {
  double distance, aside;
};
Fit fit(const Eigen::RowVectorXd& offset, const Eigen::RowVectorXd& depth, double tangent) {
  const double most = (offset - tangent * depth).maxCoeff();
  const double least = (offset + tangent * depth).minCoeff();
  return {(most - least) / (2 * tangent), (most + least) / 2};
}

}  // namespace

View frame(const Eigen::Matrix3Xd& points, const Camera& camera, int width, int height) {
  View view;
  set_directions(camera, view);
  set_opening(camera, width, height, view);
  set_origin(points, view);
  const Eigen::Matrix3Xd P =
      points.cols() > 0 ? view.framed(points) : Eigen::Matrix3Xd(Eigen::Vector3d::Zero());
  const Eigen::RowVectorXd depth = view.forward.transpose() * P;
  const double used = 1 - 2 * camera.margin;
  const Fit x = fit(view.right.transpose() * P, depth, used * view.tan_x);
  const Fit y = fit(view.up.transpose() * P, depth, used * view.tan_y);
  const double distance = std::max({x.distance, y.distance, kNearest - depth.minCoeff()});
  view.eye = x.aside * view.right + y.aside * view.up - distance * view.forward;
  return view;
}

}  // namespace deformlab
