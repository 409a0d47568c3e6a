#include "experiments/subjects/animation/mesh_measurements.h"

#include "experiments/subjects/animation/solve_log.h"

namespace deformlab {

void MeshMeasurements::add(const Shape& input, const Shape& output) {
  coherence_.add(input.V, output.V);
  keep_greatest(greatest_, distortion(input, output));
  if (region_.empty()) return;
  coherence_of_region_.add(input.V, output.V);
  const double turn = turn_between(input.V(Eigen::all, region_), output.V(Eigen::all, region_));
  keep_greatest(greatest_, {{"region.turn_max", turn}});
  keep_greatest(greatest_, region_distortion(input, output, region_));
  keep_least(least_, {{"region.turn_min", turn}});
}

void MeshMeasurements::interrupt() {
  coherence_.interrupt();
  coherence_of_region_.interrupt();
}

Metrics MeshMeasurements::metrics() const {
  Metrics all = coherence_.metrics();
  all.insert(greatest_.begin(), greatest_.end());
  all.insert(least_.begin(), least_.end());
  if (!region_.empty()) all.merge(coherence_of_region_.metrics("region."));
  return all;
}

}  // namespace deformlab
