#include "experiments/subjects/drawing/drawing_run.h"

#include <glog/logging.h>

#include "deformers/arap_2d/arap_2d.h"
#include "drawing/binding.h"
#include "experiments/measure/depth_options.h"
#include "experiments/measure/drag.h"
#include "experiments/measure/drawing_measurements.h"

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

Metrics way_of_probes(const ExperimentConfig& config, const DrawingScene& scene,
                      const Eigen::Matrix2Xd& V, double size) {
  const Eigen::Matrix3Xd places = read_probes(config.measure.probes, 2);
  const Eigen::Matrix2Xd at = places.topRows<2>();
  const Binding probes(scene.rest, Locator(scene.rest), at);
  Eigen::Matrix3Xd way = Eigen::Matrix3Xd::Zero(3, at.cols());
  way.topRows<2>() = probes(V) - at;
  return probe_metrics(way, size);
}

// Of the line through the first two handles.
Metrics beside_the_line(const DrawingScene& scene, const Shape& rest, const Handles& handles,
                        const Eigen::Matrix2Xd& V) {
  std::vector<int> vertices = handles.fixed;
  vertices.insert(vertices.end(), handles.moved.begin(), handles.moved.end());
  Eigen::Matrix3Xd places(3, std::ssize(vertices) + handles.points.cols());
  places << rest.V(Eigen::all, vertices), handles.points;
  if (places.cols() < 2) return {};
  return off_line(scene.rest, V, places.col(0).head<2>(), places.col(1).head<2>());
}

}  // namespace

Run run_drawing(const ExperimentConfig& config, const std::filesystem::path& folder,
                const std::string& caption, bool first, DrawingBook& pictures) {
  DrawingScene scene = make_drawing(config.drawing, folder);
  paint(scene, config.paint);
  const ResolvedEdit edit = resolve(read_plane_edit(config.edit), scene.rest);
  const Shape rest = to_shape(scene.rest);
  const std::unique_ptr<Deformer> deformer = make_deformer(config.method, scene);
  DrawingDepth depth(config.depth, scene.rest);
  Eigen::VectorXd depths;
  Eigen::Matrix2Xd V;
  deformer->compile(edit.handles);
  const auto [report, metrics, seconds] = drag(*deformer, rest, edit, config.drag, [&] {
    V = deformer->deformed().V.topRows<2>();
    depths = depth.update(V);
  });

  const PicturedDrawing pictured{std::make_shared<BoundDrawing>(scene.drawing, scene.rest),
                                 scene.weights, edit};
  const double size = bounding_box_diagonal(rest.V);
  Run run;
  run.V = deformer->deformed().V;
  run.size = size;
  run.solve = report.solve;
  run.notes = scene.drawing.notes;
  run.notes.insert(run.notes.end(), report.notes.begin(), report.notes.end());
  run.seconds = seconds_of(report);
  run.seconds.insert(seconds.begin(), seconds.end());
  Metrics& all = run.measured.metrics;
  all = metrics_of(report);
  all["handles"] = static_cast<double>(edit.handles.targets());
  all["handle_rms_relative"] = report.handle_rms / size;
  const auto* rigid = dynamic_cast<const Arap2d*>(deformer.get());
  if (rigid) {
    all.merge(prefixed("intermediate.", plane_distortion(scene.rest, rigid->intermediate())));
  }
  for (const Metrics& part :
       {metrics, mesh_metrics(scene), plane_distortion(scene.rest, V), depth.metrics(V),
        painted_distortion(scene.rest, V, scene.weights),
        beside_the_line(scene, rest, edit.handles, V), way_of_probes(config, scene, V, size)}) {
    all.insert(part.begin(), part.end());
  }
  if (first) pictures.add_rest(pictured);
  if (rigid && config.picture.stages) {
    pictures.add_stages(pictured, rigid->intermediate(), rigid->fitted());
  }
  pictures.add_deformed(pictured, V, depths, caption);
  for (const std::string& note : run.notes) LOG(WARNING) << note;
  return run;
}

}  // namespace deformlab
