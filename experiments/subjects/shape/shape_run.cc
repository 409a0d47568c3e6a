#include "experiments/subjects/shape/shape_run.h"

#include <glog/logging.h>

#include "experiments/measure/detail.h"
#include "experiments/measure/drag.h"
#include "experiments/measure/stripes.h"
#include "experiments/subjects/shape/cuts.h"

namespace deformlab {
namespace {

std::vector<int> nearest_vertices(const Shape& shape, const Eigen::Matrix3Xd& places) {
  std::vector<int> result;
  for (const auto p : places.colwise()) {
    Eigen::Index nearest = 0;
    (shape.V.colwise() - p).colwise().squaredNorm().minCoeff(&nearest);
    result.push_back(static_cast<int>(nearest));
  }
  return result;
}

}  // namespace

Run run_shape(const ExperimentConfig& config, const std::filesystem::path& folder,
              const std::string& caption, bool first, PictureBook& pictures) {
  const Shape rest = make_shape(config.shape, folder);
  const ResolvedEdit edit = resolve(read_edit(config.edit), rest);
  const std::unique_ptr<Deformer> deformer =
      make_deformer(config.method, rest, resolve_cuts(config.cut, rest));
  deformer->compile(edit.handles);
  const auto [report, metrics, seconds] = drag(*deformer, rest, edit, config.drag);
  const auto* embedded = as_embedded(*deformer);
  Run run;
  run.solve = report.solve;
  run.notes = report.notes;
  run.seconds = seconds_of(report);
  run.seconds.insert(seconds.begin(), seconds.end());
  run.measured.metrics = metrics_of(report);
  run.measured.metrics.insert(metrics.begin(), metrics.end());
  const double size = bounding_box_diagonal(rest.V);
  run.V = deformer->deformed().V;
  run.size = size;
  run.measured.metrics["vertices"] = static_cast<double>(rest.V.cols());
  run.measured.metrics["components"] = count_components(rest);
  run.measured.metrics["handles"] = static_cast<double>(edit.handles.targets());
  run.measured.metrics["handle_rms_relative"] = size > 0 ? report.handle_rms / size : 0;
  run.measured.metrics.merge(distortion(rest, deformer->deformed()));
  run.measured.metrics.merge(
      region_distortion(rest, deformer->deformed(), region_of(config.measure, rest)));
  if (config.measure.detail > 0) {
    run.measured.metrics.merge(detail(rest, deformer->deformed(), config.measure.detail));
  }
  if (config.measure.stripes != 0 && config.shape.file.empty()) {
    run.measured.metrics.merge(
        stripes(deformer->deformed().V, config.shape.columns, config.measure.stripes));
  }
  const std::vector<int> probes = nearest_vertices(rest, read_probes(config.measure.probes, 3));
  const Eigen::Matrix3Xd way = (deformer->deformed().V - rest.V)(Eigen::all, probes);
  run.measured.metrics.merge(probe_metrics(way, size));
  if (embedded) run.measured.metrics.merge(node_shear(embedded->transformations()));
  if (first) pictures.add_rest(*deformer, rest, edit);
  pictures.add_deformed(*deformer, edit, caption);
  for (const std::string& note : run.notes) LOG(WARNING) << note;
  return run;
}

}  // namespace deformlab
