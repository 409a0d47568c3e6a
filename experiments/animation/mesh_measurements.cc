#include "experiments/animation/mesh_measurements.h"

#include "experiments/animation/solve_log.h"

namespace deformlab {

void MeshMeasurements::add(const Shape& input, const Shape& output) {
  coherence_.add(input.V, output.V);
  keep_greatest(greatest_, distortion(input, output));
  if (watched_.empty()) return;
  coherence_of_watched_.add(input.V, output.V);
  const double turn = turn_between(input.V(Eigen::all, watched_), output.V(Eigen::all, watched_));
  keep_greatest(greatest_, {{"watched.turn_max", turn},
                            {"watched.edge_error", edge_error(input, output.V, watched_)}});
  keep_least(least_, {{"watched.turn_min", turn}});
}

void MeshMeasurements::interrupt() {
  coherence_.interrupt();
  coherence_of_watched_.interrupt();
}

Metrics MeshMeasurements::metrics() const {
  Metrics all = coherence_.metrics();
  all.insert(greatest_.begin(), greatest_.end());
  all.insert(least_.begin(), least_.end());
  if (!watched_.empty()) all.merge(coherence_of_watched_.metrics("watched."));
  return all;
}

}  // namespace deformlab
