#include "experiments/picture_options.h"

#include "experiments/render.h"

namespace deformlab {

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
