#include "experiments/subjects/picture_options.h"

#include <algorithm>

#include "geometry/core/error.h"
#include "render/render.h"

namespace deformlab {
namespace {

constexpr int kMostPixels = 4096;  // along a side of a panel

}  // namespace

void check(const PictureOptions& o) {
  if (std::min(o.width, o.height) < 1 || std::max(o.width, o.height) > kMostPixels) {
    throw InputError("picture.width × picture.height is " + std::to_string(o.width) + " × " +
                     std::to_string(o.height) + "; each is 1 to " + std::to_string(kMostPixels));
  }
  if (o.columns < 0) {
    throw InputError("picture.columns is " + std::to_string(o.columns) + "; it is 0 or more");
  }
  frame(Eigen::Matrix3Xd(3, 0), render_options(o).camera, o.width, o.height);
}

RenderOptions render_options(const PictureOptions& o) {
  RenderOptions options;
  options.width = o.width;
  options.height = o.height;
  options.camera.direction = o.direction;
  options.camera.up = o.up;
  options.light = o.light;
  return options;
}

}  // namespace deformlab
