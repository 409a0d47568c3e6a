#include "experiments/subjects/drawing/posed_drawing.h"

#include <glog/logging.h>

#include "experiments/config/override.h"
#include "experiments/measure/drawing_measurements.h"
#include "experiments/subjects/run_options.h"

namespace deformlab {
namespace {

Metrics prefixed(const std::string& prefix, const Metrics& metrics) {
  Metrics result;
  for (const auto& [name, value] : metrics) result[prefix + name] = value;
  return result;
}

Metrics mesh_metrics(const DrawingScene& scene) {
  const TriangleQuality q = quality(scene.rest);
  return {{"vertices", static_cast<double>(scene.rest.V.cols())},
          {"triangles", static_cast<double>(scene.rest.F.cols())},
          {"least_angle", q.least_angle},
          {"mean_quality", q.mean}};
}

}  // namespace

PosedDrawing::PosedDrawing(const RunOptions& options, const RunContext& context,
                           const std::vector<EditEntry>& entries)
    : scene_(make_drawing(options.drawing, context.folder, entries, read_cut_lines(options.cut))),
      page_(options.output.page) {
  for (const std::string& note : scene_.drawing.notes) LOG(WARNING) << note;
  if (context.writes()) check_output(context.command->out, scene_.drawing, options.output);
  paint(scene_, options.paint);
  rest_ = to_shape(scene_.rest);
  deformer_ = make_deformer(options.method, scene_);
  arap_ = dynamic_cast<const Arap2d*>(deformer_.get());
  depth_.emplace(options.depth, scene_.rest, depth_levels(options.depth.parts, scene_.rest));
}

ResolvedEdit PosedDrawing::resolve(const std::vector<EditEntry>& entries) const {
  const auto shown = [&](const Eigen::Vector2d& p) { return shows(scene_.drawing, p); };
  return deformlab::resolve(on_mesh(entries, scene_.rest, shown), scene_.rest);
}

void PosedDrawing::show() {
  V_ = deformer_->deformed().V.topRows<2>();
  depths_ = depth_->update(V_);
}

void PosedDrawing::reset() {
  deformer_->reset();
  depth_->reset();
}

std::shared_ptr<const BoundDrawing> PosedDrawing::bound() {
  if (!bound_)
    bound_ = std::make_shared<BoundDrawing>(scene_.drawing, scene_.rest, scene_.following);
  return bound_;
}

PicturedDrawing PosedDrawing::pictured(const ResolvedEdit& edit) {
  return {bound(), scene_.drawing.page, scene_.weights, edit, page_.fixed(scene_.drawing)};
}

Metrics PosedDrawing::metrics() const {
  Metrics metrics;
  for (const Metrics& part :
       {mesh_metrics(scene_), plane_distortion(scene_.rest, V_), depth_->metrics(V_),
        painted_distortion(scene_.rest, V_, scene_.weights)}) {
    metrics.insert(part.begin(), part.end());
  }
  if (arap_) {
    metrics.merge(prefixed("intermediate.", plane_distortion(scene_.rest, arap_->intermediate())));
  }
  return metrics;
}

void check_drawing_options(const RunOptions& options) {
  check_paint(options.paint);
  read_cut_lines(options.cut);
  check_depth_levels(options.depth.parts);
  read_probes(options.measure.probes, 2);
}

void set_drawing_defaults(const CommandLine& line, ConfigNode& root) {
  apply_override(root, {"drawing.vertices", std::to_string(line.vertices), "."});
}

}  // namespace deformlab
