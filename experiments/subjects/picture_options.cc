#include "experiments/subjects/picture_options.h"

#include "render/render.h"

namespace deformlab {
void check(const PictureOptions& o) {
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
