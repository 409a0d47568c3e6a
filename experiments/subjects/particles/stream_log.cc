#include "experiments/subjects/particles/stream_log.h"

namespace deformlab {
namespace {

double node_motion(const StreamDeformation& stream) {
  const Eigen::Matrix3Xd& g = stream.path().V;
  const Transformations X = stream.deformation().transformations();
  double sum = 0;
  for (Eigen::Index j = 0; j < g.cols(); ++j) sum += X.col(4 * j + 3).norm();
  return sum / static_cast<double>(g.cols()) / bounding_box_diagonal(g);
}

}  // namespace

void StreamLog::add(const StreamEditor& editor, ParticleFrame rows,
                    const Eigen::Matrix3Xd& edited) {
  if (editor.solves() > seen_) {
    solves_.add(editor.report(), bounding_box_diagonal(editor.stream().path().V));
  }
  seen_ = editor.solves();
  measurements_.add(editor.stream(), rows, edited);
  keep_least(least_seconds_, {{"seconds.weights", editor.seconds().weights},
                              {"seconds.transfer", editor.seconds().transfer}});
}

Run StreamLog::run(const StreamEditor& editor) const {
  Run run = solves_.run();
  run.measured.metrics["handles"] = static_cast<double>(editor.motion().handles().targets());
  run.measured.metrics["node_motion"] = node_motion(editor.stream());
  run.measured.metrics.merge(measurements_.metrics());
  run.measured.metrics["vertices"] = run.measured.metrics.at("particles");
  for (const auto& [phase, seconds] : least_seconds_) run.seconds[phase] = seconds;
  run.measured.metrics.merge(twist_of(editor.stream()));
  return run;
}

}  // namespace deformlab
