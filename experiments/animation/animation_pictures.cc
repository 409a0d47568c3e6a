#include "experiments/animation/animation_pictures.h"

namespace deformlab {

void AnimationBook::add(const Shape& frame, const Eigen::Matrix3Xd& handles,
                        const std::string& caption) {
  shapes_.push_back(std::make_unique<Shape>(frame));
  Panel panel{.shape = shapes_.back().get(), .caption = caption};
  add_balls(panel, handles, kHandleRadius * bounding_box_diagonal(frame.V), colors::kHandle);
  panels_.push_back(std::move(panel));
}

void AnimationBook::add_graph(const DeformationGraph& graph, bool input) {
  if (options_.graph == "none" || (options_.graph == "rest" && !input)) return;
  const double size = bounding_box_diagonal(shapes_.back()->V);
  deformlab::add_graph(panels_.back(), graph, graph.g, kNodeRadius * size);
}

Image AnimationBook::render() const {
  RenderOptions options;
  options.width = options_.width;
  options.height = options_.height;
  options.camera.direction = options_.direction;
  options.camera.up = options_.up;
  options.light = options_.light;
  return render_grid(panels_, options, options_.columns > 0 ? options_.columns : columns_);
}

}  // namespace deformlab
