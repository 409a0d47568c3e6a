#include "experiments/subjects/picture_options.h"

#include <Eigen/Geometry>

#include "render/render.h"
#include "render/upright.h"

namespace deformlab {
namespace {

// The direction that is to `up` as that of a Camera is to z.
Eigen::Vector3d slanted(const Eigen::Vector3d& up) {
  const Camera standard;
  if (!(up.norm() > 0)) return standard.direction;  // `frame` refuses this
  return Eigen::Quaterniond::FromTwoVectors(standard.up, up) * standard.direction;
}

}  // namespace

void check(const PictureOptions& o) {
  const Eigen::Matrix3Xd nothing(3, 0);
  frame(nothing, camera_for(o, nothing), o.width, o.height);
}

Camera camera_for(const PictureOptions& o, const Eigen::Matrix3Xd& V) {
  Camera camera;
  if (o.up) {
    camera.up = *o.up;
  } else if (!o.direction) {
    camera.up = upright_axis(V);
  }
  camera.direction = o.direction ? *o.direction : slanted(camera.up);
  return camera;
}

RenderOptions render_options(const PictureOptions& o) {
  RenderOptions options;
  options.width = o.width;
  options.height = o.height;
  options.light = o.light;
  return options;
}

}  // namespace deformlab
